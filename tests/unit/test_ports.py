# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE's prompt and its network ports: who has a prompt, and that runs without one close the ports."""
import subprocess
from types import SimpleNamespace

import pytest
import yade.remote
import yade.runtime
from ports import listening_ports
from timber_houses.run import ports


def test_servers_are_closed(monkeypatch):
    """YADE's Python prompt and XML-RPC server; a job of yade-batch keeps the latter."""
    for thread in ports.close_servers():  # those of this process
        thread.join()
    yade.remote.runServers()
    prompt, information = listening_ports()
    monkeypatch.setenv("PARAM_TABLE", "table:1")
    for thread in ports.close_servers():
        thread.join()
    assert 9000 <= prompt < 21000 <= information and listening_ports() == [information]
    monkeypatch.delenv("PARAM_TABLE")
    for thread in ports.close_servers():
        thread.join()
    assert listening_ports() == []


@pytest.mark.parametrize("options", [["-n", "-x"], ["-n"]])
def test_a_run_without_a_prompt_has_no_ports(options, tmp_path):
    """The run scripts close them."""
    script = tmp_path / "my_run.py"
    script.write_text(
        "import os\nfrom timber_houses.api.script import main\nfrom ports import listening_ports\n"
        f"main('modelA_snow', ['modelA_snow.py', '--duration', '0.001', '--no-views', '--out', '{tmp_path}'])\n"
        "print('ports', listening_ports(), flush=True)\n"
        "os._exit(0)\n")
    done = subprocess.run(["yade", *options, str(script)], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=60)
    assert "ports []" in done.stdout, done.stdout + done.stderr


@pytest.mark.parametrize("terminal, exits, prompt", [(True, False, True), (True, True, False), (False, False, False),
                                                     (False, True, False)])
def test_who_has_a_prompt(monkeypatch, terminal, exits, prompt):
    monkeypatch.setattr(yade.runtime.opts, "exitAfter", exits)
    monkeypatch.setattr(ports.sys, "stdin", SimpleNamespace(isatty=lambda: terminal))
    assert ports.has_prompt() is prompt

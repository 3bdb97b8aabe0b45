# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE's prompt and its two network ports."""
import gc
import importlib
import os
import socket
import socketserver
import sys
import threading
from contextlib import suppress


def has_prompt() -> bool:
    """Whether a user gets YADE's prompt: there is a terminal, and the session does not end with its script (`-x`)."""
    runtime = importlib.import_module("yade.runtime")
    return sys.stdin is not None and sys.stdin.isatty() and not runtime.opts.exitAfter


def close_servers():
    """Close YADE's Python prompt (port 9000 or higher) and XML-RPC server (port 21000 or higher); returns the threads
    that end them.

    YADE has no option for this. Both listen on all network interfaces: the prompt asks for a cookie of six letters, the
    other one lets anybody stop a run. Jobs of yade-batch, which reads their progress there, keep the XML-RPC server."""
    handlers = ["PythonConsoleSocketEmulator"] + ["SimpleXMLRPCRequestHandler"] * ("PARAM_TABLE" not in os.environ)
    threads = []
    for server in gc.get_objects():
        if issubclass(type(server), socketserver.BaseServer) and server.RequestHandlerClass.__name__ in handlers:
            with suppress(OSError):  # an earlier call closes it
                server.socket.shutdown(socket.SHUT_RDWR)  # the port is closed at once
            threads.append(threading.Thread(target=_close, args=(server,), daemon=True))
            threads[-1].start()
    return threads


def _close(server):
    """Stop a server of socketserver, which takes up to 0.5 s, and release its port."""
    server.shutdown()
    server.server_close()

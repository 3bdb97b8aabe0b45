# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Readers of records: every format from small synthetic files; refusals by place and member.

With YADE_TIMBER_RECORDS naming a folder of real records, those are checked against their published peaks too.
"""
import os
import re
import time
import warnings
from datetime import datetime
from pathlib import Path

import numpy as np
import pytest
from timber_houses.motion import (GAL, GroundMotion, MotionRequest, RecordError, RecordWarning, read_motion, trim,
                                write_csv)
from timber_houses.motion.readers import find_files
from timber_houses.motion.record import STANDARD_GRAVITY
from timber_houses.motion.text import direction_of

pytestmark = pytest.mark.filterwarnings("ignore:.*constant part")  # of the few samples below
N = 40
WAVES = {name: 100.0 * np.sin(0.3 * np.arange(N) + k) for k, name in enumerate(("ns", "ew", "ud"))}
"""Three components in gal."""

KNET_ROUNDING = 0.01
"""Half a count of the scale factor below, and the mean of the counts, in gal."""


def knet_text(values, direction, long="Long.", peak="Max. Acc. (gal)", rate=10, duration=N // 10, stated=None):
    counts = np.round(values * 1000).astype(int) + 13000
    gal = (counts - counts.mean()) / 1000.0
    header = [
        "Origin Time       2004/10/23 17:56:00",
        "Lat.              37.3",
        f"{long:18}138.9",
        "Depth. (km)       13",
        "Mag.              6.8",
        "Station Code      TST001",
        "Station Lat.      37.3",
        f"Station {long:10}138.8",
        "Station Height(m) 56",
        "Record Time       2004/10/23 17:56:20",
        f"Sampling Freq(Hz) {rate}Hz",
        f"Duration Time(s)  {duration}",
        f"Dir.              {direction}",
        "Scale Factor      2000(gal)/2000000",
        f"{peak:18}{np.abs(gal).max() if stated is None else stated:.3f}",
        "Last Correction   2004/10/23 17:56:00",
        "Memo.             ",
    ]
    rows = [" ".join(f"{c:8d}" for c in counts[i : i + 8]) + " " for i in range(0, len(counts), 8)]
    return "\n".join(header + rows) + "\n"


def at2_text(values_gal, direction, card="NPTS=  {n}, DT=   .0200 SEC,", title="Somewhere, 1/1/2000, TST, "):
    g = values_gal * GAL / STANDARD_GRAVITY
    rows = ["".join(f"{v:15.7E}" for v in g[i : i + 5]) for i in range(0, len(g), 5)]
    head = ["PEER NGA STRONG MOTION DATABASE RECORD", title + direction, "ACCELERATION TIME SERIES IN UNITS OF G"]
    return "\n".join(head + [card.format(n=len(g))] + rows) + "\n"


KNET_CSV_HEAD = [
    *("#K-NET CSV", "#Event", "#OriginTime,Latitude,Longitude,Depth(km),Magnitude",
      "#2020/02/02 02:02:00,35.000,135.000,10,6.0", "#Station"),
    *("#Code,Latitude,Longitude,Height(m)", "#XXX001,35.1000,135.1000,10", "#Record", "#SamplingFrequency(Hz)", "#10",
      "#DurationTime(s)", "#{duration}"),
    *("#Offset", "#N-S(gal),E-W(gal),U-D(gal)", "#0.10,1.70,16.50"),
]


def knet_csv_text(columns="N-S(gal),E-W(gal),U-D(gal)", factors=(1, 1, 1), head=KNET_CSV_HEAD, duration=N // 10,
                  clock=True):
    """NIED's CSV: offsets of 0.1, 1.7, 16.5 gal left in; a factor on the wave of each column."""
    waves = [
        factor * WAVES[name] + offset
        for name, offset, factor in zip(("ns", "ew", "ud") * 2, (0.1, 1.7, 16.5) * 2, factors)
    ]
    names = f"#{'Time,' * clock}RelativeTime(s),{columns}"
    times = [(f"2020/02/02 02:02:{10 + k / 10:05.2f}," if clock else "") + f"{k / 10:.2f}" for k in range(N)]
    rows = [",".join([time, *(f"{value:.4f}" for value in row)]) for time, row in zip(times, np.transpose(waves))]
    return "\n".join([*head, names, *rows]).format(duration=duration) + "\n"


def write(folder, name, text, encoding="utf-8"):
    path = folder / name
    path.write_bytes(text.encode(encoding))
    return path


def knet_record(folder, suffix="", directions=("N-S", "E-W", "U-D"), **header):
    for name, direction in zip(("ns", "ew", "ud"), directions):
        write(folder, f"TST001.{name.upper()}{suffix}", knet_text(WAVES[name], direction, **header))
    return folder / "TST001"


def same_waves(motion, tolerance):
    """The motion's components are WAVES, each without its mean, within `tolerance` [gal]."""
    for name, wave in WAVES.items():
        np.testing.assert_allclose(getattr(motion, name) / GAL, wave - wave.mean(), atol=tolerance)


# --- K-NET and KiK-net --------------------------------------------------------------------------


@pytest.mark.parametrize("header", [{}, {"long": "Lon.", "peak": "Max Acc. (gal)"}])
def test_knet_prefix_in_both_spellings(tmp_path, header):
    motion = read_motion(knet_record(tmp_path, **header))
    assert (motion.dt, len(motion), motion.duration) == (0.1, N, pytest.approx(4.0))
    same_waves(motion, KNET_ROUNDING)


def test_first_sample_is_15_s_before_the_record_time(tmp_path):
    """K-NET's Record Time includes the trigger delay; JMA's INITIAL TIME is the first sample's."""
    assert read_motion(knet_record(tmp_path)).begins == datetime(2004, 10, 23, 17, 56, 5)
    jma = write(tmp_path, "jma.csv", JMA_OLD + "1,2,3\n1,2,3\n")
    assert read_motion(jma).begins == datetime(2004, 10, 23, 17, 56)
    assert trim(read_motion(tmp_path / "TST001"), 2.0).begins == datetime(2004, 10, 23, 17, 56, 7)


def test_components_of_two_recordings_are_refused(tmp_path):
    later = tmp_path / "TST001.UD"
    knet_record(tmp_path)
    later.write_text(later.read_text().replace("17:56:20", "17:56:21"))
    with pytest.raises(RecordError, match="begin at different times"):
        read_motion(tmp_path / "TST001")


def test_kiknet_surface_is_taken_and_borehole_can_be_named(tmp_path):
    knet_record(tmp_path, "1", directions="123")
    surface = {name: wave * 2 for name, wave in WAVES.items()}
    for name, direction in zip(("ns", "ew", "ud"), "456"):
        write(tmp_path, f"TST001.{name.upper()}2", knet_text(surface[name], direction))
    assert np.abs(read_motion(tmp_path / "TST001").ns).max() > 1.5
    files = ",".join(str(tmp_path / f"TST001.{c}1") for c in ("UD", "EW", "NS"))
    same_waves(read_motion(files), KNET_ROUNDING)


@pytest.mark.parametrize("lost", ["UD2", "NS1"])
def test_kiknet_with_a_file_missing(tmp_path, lost):
    """Of the surface: an error, not the borehole; of the borehole: of no account."""
    for sensor in "12":
        knet_record(tmp_path, sensor, directions="123")
    (tmp_path / f"TST001.{lost}").unlink()
    if lost == "NS1":
        assert "TST001.NS2" in read_motion(tmp_path / "TST001").source
    else:
        with pytest.raises(RecordError, match="found only TST001.EW2, TST001.NS2"):
            read_motion(tmp_path / "TST001")


def test_single_knet_file_leaves_the_others_zero(tmp_path):
    knet_record(tmp_path)
    motion = read_motion(tmp_path / "TST001.EW")
    assert motion.pga_gal["ns"] == motion.pga_gal["ud"] == 0.0 and motion.pga_gal["ew"] > 90.0
    assert "the other components are zero" in motion.source


def test_knet_peak_other_than_its_header_warns(tmp_path):
    path = write(tmp_path, "a.NS", knet_text(WAVES["ns"], "N-S", stated=50.0))
    with pytest.warns(RecordWarning, match="header says 50 gal"):
        read_motion(path)


@pytest.mark.parametrize("time", ["24:56:20", "17:56:" + "9" * 300, "x"])
@pytest.mark.parametrize("date", ["2004/10/23", "0/10/23", "1/1/1", "9999999999/10/23"])
def test_a_start_time_that_cannot_be_read_is_a_note(tmp_path, date, time):
    path = write(tmp_path, "a.NS", knet_text(WAVES["ns"], "N-S").replace("2004/10/23 17:56:20", f"{date} {time}"))
    with pytest.warns(RecordWarning,
                      match="a.NS:10: Record Time: .* is not a date and time .*; the record is read without it"):
        motion = read_motion(path)
    assert motion.begins is None and motion.pga_gal["ns"] > 90


@pytest.mark.parametrize("label", ["Record Time", "Max. Acc. (gal)"])
def test_knet_without_an_optional_line(tmp_path, label):
    text = "".join(
        line if not line.startswith(label) else "Memo.\n" for line in knet_text(WAVES["ns"], "N-S").splitlines(True))
    assert read_motion(write(tmp_path, "a.NS", text)).pga_gal["ns"] > 90


# --- CSV of K-NET and KiK-net -------------------------------------------------------------------


SURFACE_LAST = "N-S{0}(gal),E-W{0}(gal),U-D{0}(gal),N-S{1}(gal),E-W{1}(gal),U-D{1}(gal)"
KNET_CSVS = {
    "K-NET": {},
    "without a date": {"clock": False},
    "KiK-net, channels numbered": {"columns": SURFACE_LAST.format("1", "2"), "factors": (3, 3, 3, 1, 1, 1)},
    "KiK-net, sensors named": {
        "columns": SURFACE_LAST.format("[Surface]", "[Borehole]"), "factors": (1, 1, 1, 3, 3, 3)
    },
    "KiK-net, names repeated": {"columns": SURFACE_LAST.format("", ""), "factors": (3, 3, 3, 1, 1, 1)},
    "without an offset": {"head": KNET_CSV_HEAD[:12]},
    "without labels": {"head": []},
}


@pytest.mark.parametrize("form", KNET_CSVS.values(), ids=KNET_CSVS.keys())
@pytest.mark.parametrize("encoding, end", [("utf-8", ""), ("utf-8-sig", ",,")])
def test_knet_csv(tmp_path, form, encoding, end):
    """Offsets are removed as from K-NET's ASCII files; of two sensors that at the surface counts; a spreadsheet adds
    commas.
    """
    motion = read_motion(write(tmp_path, "a.csv", knet_csv_text(**form).replace("\n", f"{end}\r\n"), encoding))
    assert motion.dt == pytest.approx(0.1)
    same_waves(motion, 1e-3)
    assert motion.begins == (datetime(2020, 2, 2, 2, 2, 10) if form.get("clock", True) else None)


# --- PEER AT2 -----------------------------------------------------------------------------------

CARDS = [
    "NPTS=   {n}, DT=   .0200 SEC,                 ",
    "NPTS =   {n} , DT =   .020 SEC ,",
    "NPTS={n},DT=0.02 SEC",
    "   {n}    0.0200   NPTS, DT",
    "NPTS= {n}, DT=.02",
    "NPTS=   {n} DT=   .02000 SEC",
    "{n}, 0.02 NPTS,DT",
]


@pytest.mark.parametrize("card", CARDS)
def test_at2_header_spacings(tmp_path, card):
    path = write(tmp_path, "X000.AT2", at2_text(WAVES["ns"], "000", card))
    motion = read_motion(path)
    assert motion.dt == 0.02
    np.testing.assert_allclose(motion.ns / GAL, WAVES["ns"], rtol=1e-6)


def test_at2_azimuth_gives_signs_and_projections(tmp_path):
    south = read_motion(write(tmp_path, "S180.AT2", at2_text(WAVES["ns"], "180")))
    np.testing.assert_allclose(south.ns / GAL, -WAVES["ns"], rtol=1e-6)
    oblique = read_motion(write(tmp_path, "S030.AT2", at2_text(WAVES["ns"], "30")))
    np.testing.assert_allclose(oblique.ew / GAL, 0.5 * WAVES["ns"], rtol=1e-6)


def test_at2_component_stated_by_the_caller(tmp_path):
    path = write(tmp_path, "nowhere.AT2", at2_text(WAVES["ud"], "somewhere"))
    with pytest.raises(RecordError, match="direction not stated; give it: --component"):
        read_motion(path)
    np.testing.assert_allclose(read_motion(path, component="ud").ud / GAL, WAVES["ud"], rtol=1e-6)
    numbered = write(tmp_path, "k_001.at2", at2_text(WAVES["ew"], "090"))
    with pytest.raises(RecordError, match="90.0 in the title but 1.0 in the file name; state component="):
        read_motion(numbered)
    np.testing.assert_allclose(read_motion(numbered, component="ew").ew / GAL, WAVES["ew"], rtol=1e-6)


@pytest.mark.parametrize("suffixes, titles", [
    (("000", "090", "-UP"), ("0", "90", "UP")), (("NS", "EW", "UD"), ("somewhere",) * 3), (("NS2", "EW2", "UD2"), None),
    (("HNN", "HNE", "HNZ"), None), (("N00E", "N90E", "UP"), None)])
def test_at2_prefix_finds_three_components(tmp_path, suffixes, titles):
    """Azimuths, and the namings of NGA-West2. titles: directions in the files, those of the names by default"""
    for wave, suffix, title in zip(WAVES.values(), suffixes, titles or suffixes):
        write(tmp_path, f"RSN1_NIG019{suffix}.AT2", at2_text(wave, title))
    motion = read_motion(tmp_path / "RSN1_NIG019")
    assert motion.name.startswith("RSN1_NIG019")
    for name, wave in WAVES.items():
        np.testing.assert_allclose(getattr(motion, name) / GAL, wave, rtol=1e-6)


@pytest.mark.parametrize("ends", [("-E", "-N", "-V"), ("_e", "_n", "_z")])
def test_at2_prefix_with_single_letters(tmp_path, ends):
    for end in ends:
        write(tmp_path, f"CHICHI{end}.AT2",
              "PEER\n" + f"A, 1, STA, {end[1:].upper()}\nACCELERATION IN UNITS OF G\nNPTS=  3, DT= .01 SEC\n.1 .2 .3\n")
    assert [path.name for path in find_files(tmp_path / "CHICHI")] == [f"CHICHI{end}.AT2" for end in ends]


def test_prefix_up_to_the_point_that_a_shell_completes(tmp_path):
    same_waves(read_motion(f"{knet_record(tmp_path)}."), KNET_ROUNDING)


def test_numbers_of_fortran_and_the_end_of_a_dos_file(tmp_path):
    path = write(tmp_path, "a.csv", "# dt: 0.01\nns [gal]\n-.1416764D-03\n.1D-1\n0.2E+01\n\x1a")
    assert read_motion(path).ns / GAL == pytest.approx([-0.1416764e-3, 0.01, 2.0])


@pytest.mark.parametrize("head", ["# dt: 0.01,,\nns [gal],ew [gal],,\n", '"# dt: 0.01",,\n"ns [gal]","ew [gal]",,\n',
                                  "# dt: 0.01;;\nns [gal];ew [gal];;\n"])
def test_csv_from_a_spreadsheet(tmp_path, head):
    """Quoted comments, short rows filled with delimiters."""
    rows = "1,2,,\n3,4,,\n" if "," in head else "1;2;;\n3;4;;\n"
    motion = read_motion(write(tmp_path, "a.csv", head + rows))
    assert motion.dt == 0.01 and motion.ew / GAL == pytest.approx([2, 4])


def test_peknold(tmp_path):
    text = (
        "Data for El Centro 1940 North South Component (Peknold Version)\n"
        f"{N} points at equal spacing of 0.02 sec\n"
        "Points are listed in the format of 8F10.5, i.e., 8 points across in a row with 5 decimal places\n"
        "The units are (g)\n\n*** Begin data ***\n"
    )
    g = WAVES["ns"] * GAL / STANDARD_GRAVITY
    text += "\n".join("".join(f"{v:10.5f}" for v in g[i : i + 8]) for i in range(0, N, 8))
    motion = read_motion(write(tmp_path, "elcentro.dat", text))
    assert motion.dt == 0.02
    np.testing.assert_allclose(motion.ns / GAL, WAVES["ns"], atol=0.005)  # half of the fifth decimal of g


# --- JMA CSV ------------------------------------------------------------------------------------

JMA_OLD = "SITE CODE= 4310B 小千谷市城内\n LAT.=  37.31\n LON.= 138.79\n SAMPLING RATE= 100Hz\n"
JMA_OLD += " UNIT  = gal(cm/s/s)\n INITIAL TIME = 2004 10 23 17 56 00\nNS,EW,UD\n"
JMA_NEW = "SITE CODE=4310B,小千谷市城内,,\nLAT.=37.31,,,\nLON.=138.79,,,\nSAMPLING RATE=100Hz,,,\n"
JMA_NEW += "UNIT=gal(cm/s/s),,,\nINITIAL TIME=2004 10 23 17 56 00,,,\nNS,EW,UD,\n"


@pytest.mark.parametrize("header", [JMA_OLD, JMA_NEW, JMA_NEW.replace("SAMPLING RATE", "Sampling Freq")])
@pytest.mark.parametrize("encoding", ["cp932", "utf-8"])
def test_jma_headers(tmp_path, header, encoding):
    rows = "\n".join(f"{a:.4f},{b:.4f},{c:.4f}" for a, b, c in zip(*(WAVES[k] for k in ("ns", "ew", "ud"))))
    motion = read_motion(write(tmp_path, "jma.csv", header + rows, encoding))
    assert motion.dt == 0.01
    for name, wave in WAVES.items():
        np.testing.assert_allclose(getattr(motion, name) / GAL, wave, atol=1e-4)


STARTS = {
    "95 01 17 05 47 31": datetime(1995, 1, 17, 5, 47, 31),
    "04/10/23 17:56:00": datetime(2004, 10, 23, 17, 56),
    "1995,01,17,05,46,50.25": datetime(1995, 1, 17, 5, 46, 50, 250_000),
    "2016-04-16T01:25": datetime(2016, 4, 16, 1, 25),
    "68 01 01 00 00 00": datetime(2068, 1, 1),
    "69 01 01 00 00 00": datetime(1969, 1, 1),
    "": None,
}


@pytest.mark.parametrize("text, start", STARTS.items(), ids=STARTS.keys())
@pytest.mark.filterwarnings("error")
def test_jma_start_times(tmp_path, text, start):
    """Two digits of a year are 19xx or 20xx; rows end in empty cells, as in the archive of 1995."""
    head = JMA_OLD.replace("2004 10 23 17 56 00", text).replace("\n", ",,,\r\n")
    path = write(tmp_path, "jma.csv", head + "".join(f"{a},{-a},{2 * a},,,\r\n" for a in (1, -1, 2, -2)), "cp932")
    assert read_motion(path).begins == start


@pytest.mark.parametrize(
    "text", ["95 01 17", "95 13 17 05 47 31", "****", "195 01 17 05 47 31", "95 01 17 25 47 31", "19950117054731"])
def test_jma_start_time_that_cannot_be_read(tmp_path, text):
    path = write(tmp_path, "jma.csv", JMA_OLD.replace("2004 10 23 17 56 00", text) + "1,2,3\n-1,-2,-3\n", "cp932")
    with pytest.warns(RecordWarning, match="jma.csv:6: 'INITIAL TIME': .*the record is read without it"):
        assert read_motion(path).begins is None


# --- plain CSV ----------------------------------------------------------------------------------


def csv_text(head, columns=("ns", "ew", "ud"), dt=None):
    rows = np.column_stack(([np.arange(N) * dt] if dt else []) + [WAVES[c] for c in columns])
    return head + "\n" + "\n".join(",".join(f"{v:.6f}" for v in row) for row in rows) + "\n"


@pytest.mark.parametrize("text, units", [
    (csv_text("# units: gal\n# dt: 0.02\nns,ew,ud"), None),
    (csv_text("# dt: 0.02\nns,ew,ud"), "gal"),
    (csv_text("time,NS [gal],EW [gal],UD [gal]", dt=0.02), None),
    (csv_text("time [s],north_gal,east_gal,up_gal", dt=0.02), None),
    (csv_text("time [ms],ns [gal],ew [gal],ud [gal]", dt=20), None),
    (csv_text("# unit = cm/s2\n# sampling: 50 Hz\nUD,N-S,E-W", ("ud", "ns", "ew")), "gal"),
    (csv_text("# units: gal\n# dt: 0.02\nns;ew;ud").replace(",", ";"), None),
    (csv_text("# units: gal\n# time,ns,ew,ud", dt=0.02), None),
    (csv_text("# NPTS: 40, from an AT2 file\n# units: gal\n# dt: 0.02\nns,ew,ud"), None),
    (csv_text("# units: gal\n# dt: 0.02\nns,ew,ud\n# values") + "# end of record\n", None),
    (csv_text("# units: gal\n# dt: 0.02\nns,ew,ud").replace(",", '" , "'), None),
    (csv_text("# dt: 0.02\n# sampling: 50 Hz\n# dt: 0.02\nns_gal,ew_gal,ud_gal"), None),
])
def test_plain_csv_forms(tmp_path, text, units):
    motion = read_motion(write(tmp_path, "a.csv", text), units=units)
    assert motion.dt == pytest.approx(0.02)
    for name, wave in WAVES.items():
        np.testing.assert_allclose(getattr(motion, name) / GAL, wave, atol=1e-5)


@pytest.mark.parametrize("rate, digits", [(256, 3), (200, 2)])
def test_rounded_times_beside_a_stated_step(tmp_path, rate, digits):
    rows = "\n".join(f"{k / rate:.{digits}f},{v:.6f}" for k, v in enumerate(WAVES["ns"]))
    path = write(tmp_path, "a.csv", f"# dt: {1 / rate}\ntime,ns_gal\n{rows}\n")
    assert read_motion(path).dt == 1 / rate


@pytest.mark.parametrize("component, azimuth", [
    ("-90", 270), ("22.5", 22.5), ("0.5", 0.5), ("45.0", 45), ("360", 0), ("090", 90), ("N-S", 0), ("-UP", "up"),
    ("361", None), ("-1e9", None), ("nan", None), ("north-west", None), ("N10E", 10), ("N90E", 90), ("S10E", 170),
    ("S20W", 200), ("N15W", 345), ("N00E", 0), ("HNN", 0), ("HNE", 90), ("HNZ", "up"), ("BLE", 90), ("NS2", 0),
    ("EW1", 90), ("UD2", "up"), ("L", None), ("T", None), ("HNX", None), ("N100E", None)])
def test_directions(component, azimuth):
    assert direction_of(component) == azimuth


def test_units_scale(tmp_path):
    path = write(tmp_path, "a.csv", csv_text("# dt: 0.02\nns,ew,ud"))
    for unit, size in (("m/s2", 1.0), ("g", STANDARD_GRAVITY), ("gal", 0.01)):
        np.testing.assert_allclose(read_motion(path, units=unit).ns, WAVES["ns"] * size, atol=1e-5)


def test_written_csv_reads_back(tmp_path):
    motion = GroundMotion(0.01, np.column_stack([WAVES[k] for k in ("ew", "ns", "ud")]) * GAL)
    write_csv(motion, tmp_path / "out.csv", ["seed: 1"])
    again = read_motion(tmp_path / "out.csv")
    np.testing.assert_allclose(again.acceleration / GAL, motion.acceleration / GAL, atol=0.0051)


# --- the house's axes ---------------------------------------------------------------------------


def test_angle_turns_the_record_in_the_house(tmp_path):
    path = write(tmp_path, "a.csv", csv_text("# units: gal\n# dt: 0.02\nns,ew,ud"))
    turned = read_motion(path, angle=90.0)
    np.testing.assert_allclose(turned.ew / GAL, WAVES["ns"], atol=1e-5)
    np.testing.assert_allclose(turned.ns / GAL, -WAVES["ew"], atol=1e-5)
    plain, oblique = read_motion(path), read_motion(path, angle=33.0)
    lengths = [np.linalg.norm(m.acceleration[:, :2], axis=1) for m in (plain, oblique)]
    np.testing.assert_allclose(*lengths, rtol=1e-12)


# --- refusals -----------------------------------------------------------------------------------


HOW = "convert it to a plain CSV: a line '# dt: 0.01'"
"""What each refusal of another form says."""
REFUSALS = {  # name of the file, its text, place and members in the message
    "unknown format": ("a.txt", lambda: "hello\nworld\n", f"a.txt: unknown record format; {HOW}.*K-NET"),
    "unknown columns": ("a.csv", lambda: "t,AccX,AccY\n0,1,2\n", f"a.csv: unknown record format; {HOW}"),
    "COSMOS": ("a.V2", lambda: "Corrected acceleration    (Format v01.20 with 13 text lines)\n",
               f"a.V2: COSMOS format.*; {HOW}"),
    "GeoNet": ("a.V2A", lambda: "Corrected accelerogram\nGeoNet site 163541 CHHC\n",
               f"a.V2A: GeoNet V1 to V3 format.*; {HOW}"),
    "CSMIP": ("a.V2", lambda: "CORRECTED ACCELEROGRAM 24278-S2486-94020.01\nSTATION\n",
              f"a.V2: CSMIP V1 to V3 format.*; {HOW}"),
    "SMC": ("a.smc", lambda: "2 CORRECTED ACCELEROGRAM\n*\n", f"a.smc: SMC .*; {HOW}"),
    "ESM": ("a.ASC", lambda: "EVENT_NAME: NORCIA\nEVENT_ID: X\n", f"a.ASC: ESM or ITACA format.*; {HOW}"),
    "miniSEED": ("a.mseed", lambda: "000001D IU COLO" + "\0" * 500, f"a.mseed: miniSEED, which is not read; {HOW}"),
    "SAC": ("a.sac", lambda: "\0" * 304 + "\6\0\0\0" + "\0" * 500, f"a.sac: SAC, which is not read; {HOW}"),
    "archive": ("a.zip", lambda: "PK\3\4\0\0", "a.zip: archive .*; unpack it"),
    "DT before NPTS": ("a000.AT2", lambda: at2_text(WAVES["ns"], "0", "DT= .02 SEC, NPTS= {n}"),
                       f"a000.AT2:4: .*NPTS first, or {HOW}"),
    "no NPTS": ("a000.AT2", lambda: at2_text(WAVES["ns"], "0", "NPTS"), f"a000.AT2: AT2 header without .*{HOW}"),
    "two samples too many": ("a000.AT2", lambda: at2_text(WAVES["ns"], "0", "NPTS= 38, DT= .02 SEC"),
                             f"a000.AT2: too long, 40 .*NPTS says 38.*{HOW}"),
    "truncated K-NET CSV": ("a.csv", lambda: knet_csv_text(duration=5),
                            f"a.csv: truncated, 40 samples; DurationTime .*50.*{HOW}"),
    "K-NET CSV without columns": ("a.csv", lambda: "#K-NET CSV\n#Event\n1,2\n",
                                  f"a.csv: K-NET CSV without a row.*{HOW}"),
    "gap in K-NET CSV": ("a.csv", lambda: knet_csv_text().replace("\n2020/02/02 02:02:11.00",
                                                                  "\n2020/02/02 02:02:11.00,1.04,1,1,1\n#"), "a.csv:"),
    "empty": ("a.txt", lambda: "", "a.txt"),
    "only the end of a DOS file": ("a.txt", lambda: "\x1a", "a.txt"),
    "no unit": ("a.csv", lambda: csv_text("# dt: 0.02\nns,ew,ud"), "a.csv: .*units="),
    "contradicting units": ("a.csv", lambda: csv_text("# units: g\n# dt: 0.02\nns_gal,ew_gal,ud_gal"),
                            "a.csv: .*g, gal"),
    "unknown unit": ("a.csv", lambda: csv_text("# units: furlong\n# dt: 0.02\nns,ew,ud"), "a.csv: .*'furlong'"),
    "no step": ("a.csv", lambda: csv_text("# units: gal\nns,ew,ud"), "a.csv: .*# dt"),
    "time in minutes": ("a.csv", lambda: csv_text("time [min],ns [gal],ew [gal],ud [gal]", dt=0.02), "a.csv: .*'min'"),
    "dt of zero": ("a.csv", lambda: csv_text("# units: gal\n# dt: 0\nns,ew,ud"), "a.csv:2: dt: .*0.0001 and 1 s"),
    "gap in time": ("a.csv", lambda: "# units: gal\ntime,ns\n0,1\n0.01,1\n0.02,1\n0.04,1\n", "a.csv: sample"),
    "short row": ("a.csv", lambda: "# units: gal\n# dt: 0.01\nns,ew\n1,2\n3\n", "a.csv:5: 1 values.* 2 "),
    "fewer rows than stated": ("a.csv", lambda: "# units: gal\n# dt: 1\n# samples: 3\nns\n1\n2\n",
                               "a.csv: .*2 samples.*# samples.* 3"),
    "step against rate": ("a.csv", lambda: csv_text("# dt: 0.02\n# sampling: 100 Hz\nns_gal,ew_gal,ud_gal"),
                          "a.csv:1: dt: 0.02 s contradicts"),
    "two steps": ("a.csv", lambda: csv_text("# dt: 0.02\n# dt: 0.01\nns_gal,ew_gal,ud_gal"),
                  "a.csv:2: dt: '0.01' contradicts '0.02'"),
    "two units": ("a.csv", lambda: csv_text("# units: gal\n# units: g\n# dt: 0.02\nns,ew,ud"),
                  "a.csv:2: units: 'g' contradicts 'gal'"),
    "underscores": ("a.csv", lambda: "# units: gal\n# dt: 1\nns\n1\n1_000\n", "a.csv:5: '1_000'"),
    "underscores in AT2": ("a000.AT2", lambda: at2_text(WAVES["ns"], "0").replace("0.0", "0_0", 1), "a000.AT2:"),
    "samples of 1e300": ("a.csv", lambda: csv_text("# units: gal\n# dt: 1\n# samples: 1e300\nns,ew,ud"),
                         "a.csv:3: samples: '1e300'"),
    "NaN in CSV": ("a.csv", lambda: "# units: gal\n# dt: 0.01\nns\n1\nnan\n", "a.csv:5: 'nan'"),
    "truncated AT2": ("a000.AT2", lambda: at2_text(WAVES["ns"], "0", "NPTS= 50, DT= .02 SEC"),
                      "a000.AT2: .*40 samples; NPTS .*50"),
    "AT2 of many digits": ("a000.AT2", lambda: at2_text(WAVES["ns"], "0", f"NPTS= {'9' * 900}, DT= .02 SEC"),
                           "a000.AT2:4: NPTS"),
    "NaN in AT2": ("a000.AT2", lambda: at2_text(np.r_[WAVES["ns"][:-1], np.nan], "0"), "a000.AT2:12: 'NAN'"),
    "word in AT2": ("a000.AT2", lambda: at2_text(WAVES["ns"], "0") + "what\n", "a000.AT2:13: 'what'"),
    "AT2 without unit": ("a000.AT2", lambda: at2_text(WAVES["ns"], "0").replace(" IN UNITS OF G", ""),
                         "a000.AT2: .*units="),
    "unit of many words": ("a000.AT2", lambda: at2_text(WAVES["ns"], "0").replace("UNITS OF G", "units " * 150),
                           "a000.AT2: .*'units'"),
    "velocity": ("a000.VT2", lambda: at2_text(WAVES["ns"], "0").replace("ACCELERATION", "VELOCITY"),
                 "a000.VT2:3: velocity"),
    "title against name": ("a090.AT2", lambda: at2_text(WAVES["ns"], "0"), "a090.AT2: .*component="),
    "truncated K-NET": ("a.NS", lambda: knet_text(WAVES["ns"], "N-S", duration=5),
                        "a.NS: .*40 samples; Duration Time .*50"),
    "K-NET header cut": ("a.NS", lambda: "Origin Time  2004/10/23\nLat. 3\n", "a.NS: .*'Record Time'"),
    "scale of K-NET": ("a.NS", lambda: knet_text(WAVES["ns"], "N-S").replace("/2000000", "/0"),
                       "a.NS:14: Scale Factor"),
    "scale of two points": ("a.NS", lambda: knet_text(WAVES["ns"], "N-S").replace("2000(gal)", "1.2.3(gal)"),
                            "a.NS:14: Scale Factor: '1.2.3'"),
    "JMA without rate": ("a.csv", lambda: "SITE CODE=1\nUNIT=gal\nNS,EW,UD\n1,2,3\n1,2,3\n", "a.csv: .*SAMPLING RATE"),
    "JMA rate of zero": ("a.csv", lambda: "SITE CODE=1\nSAMPLING RATE=0Hz\nUNIT=gal\nNS,EW,UD\n1,2,3\n1,2,3\n",
                         "a.csv:2: 'SAMPLING RATE'"),
    "JMA without unit": ("a.csv", lambda: "SITE CODE=1\nSAMPLING RATE=100Hz\nNS,EW,UD\n1,2,3\n1,2,3\n",
                         "a.csv: .*units="),
    "impossible acceleration": ("a.csv", lambda: "# units: g\n# dt: 0.01\nns\n1\n120\n",
                                "a.csv: .*1.18e[+]03 m/s2.* 1000 m/s2"),
    "long line": ("a.csv", lambda: "# " + "a" * 100_000 + "\n" + csv_text("# units: gal\n# dt: 0.02\nns,ew,ud"),
                  "a.csv:1: .*100002 .* 1000"),
    "long comment": ("a.csv", lambda: "#" + " a" * 450 + "\n" + csv_text("# dt: 0.02\nns,ew,ud"), "a.csv: .*units="),
    "long unit of a column": ("a.csv", lambda: csv_text("# dt: 0.02\nns [" + " _" * 400 + "x,ew,ud"), "a.csv: "),
    "many samples": ("a.csv", lambda: "# units: gal\n# dt: 0.01\nns\n" + "1\n" * 200_001, "a.csv:200004: .*200000"),
    "many lines": ("a.csv", lambda: "#\n" * 500_000, "a.csv: 500000 .*400000"),
    "large file": ("a.csv", lambda: "#\n" * 6_000_000, "a.csv: .*10 MB"),
}


@pytest.mark.parametrize("name, text, message", REFUSALS.values(), ids=REFUSALS.keys())
def test_refusals_name_file_line_and_member(tmp_path, name, text, message):
    path = write(tmp_path, name, text())
    start = time.process_time()
    with pytest.raises(RecordError, match=message) as caught:
        read_motion(path)
    assert time.process_time() - start < 5  # observed: 0.4 s
    assert str(caught.value).isprintable()


def test_paths_that_are_no_file(tmp_path):
    os.mkfifo(tmp_path / "pipe.csv")
    for record in ("", "9" * 30, "9" * 5000, "," * 5000, "~no-such-user/x", "a/" * 3000, "a\0b", "\udcff", "/dev/zero",
                   "/dev/zero,/dev/zero", tmp_path / "pipe.csv"):
        with pytest.raises(RecordError) as caught:
            read_motion(record)
        assert str(caught.value).isprintable()


@pytest.mark.parametrize("name, value", [("seed", 10**29), ("seed", 10**400), ("detrend", 10**400), ("azimuth", np.inf),
                                         ("azimuth", np.nan), ("pga", np.inf), ("highpass", 1e308), ("scale", 1e308),
                                         ("record", "")])
def test_options_out_of_range(name, value):
    """The message opens with the option, or with the file's name where that is empty."""
    with pytest.raises(RecordError) as caught:
        request = MotionRequest(**{name: value})
        request.check()
        request.motion(0.01)
    assert str(caught.value).startswith(f"--{name} ") or value == ""
    assert str(caught.value).isprintable()


def test_control_characters_in_file_names_stay_out_of_the_source(tmp_path):
    path = write(tmp_path, "a\nb\x1b.csv", csv_text("# units: gal\n# dt: 0.02\nns,ew,ud"))
    motion = read_motion(path)
    assert motion.name.isprintable() and motion.source.isprintable()


def test_scale_beyond_any_ground_motion(tmp_path):
    path = write(tmp_path, "a.csv", csv_text("# units: gal\n# dt: 0.02\nns,ew,ud"))
    with pytest.raises(RecordError, match="1000 m/s2"):
        MotionRequest(record=str(path), scale=1e5).motion(0.02)


@pytest.mark.parametrize("peak, more, expected", [
    (0.8, {}, "peak 0.8 gal, .*0.8 m/s2 \\(80 gal\\) or 0.8 g \\(785 gal\\)"),
    (8.2, {}, "peak 8.2 gal, .*8.2 m/s2 \\(820 gal\\)"),
    (300, {"pga": 0.8}, "peak 0.8 gal, .*0.8 g \\(785 gal\\)"),
    (300, {"scale": 0.01}, "peak 3 gal, "),
    (300, {}, None), (0.0, {}, None),
])
def test_a_motion_in_another_unit_is_noted(tmp_path, peak, more, expected):
    """Records in g or m/s2 read as gal, and a PGA in g."""
    path = write(tmp_path, "a.csv", "# units: gal\n# dt: 0.02\nns\n" + f"{peak}\n{-peak}\n" * 50)
    with warnings.catch_warnings(record=True) as notes:
        warnings.simplefilter("always")
        MotionRequest(record=str(path), **more).motion(0.02)
    texts = [str(note.message) for note in notes]
    assert len(texts) == (expected is not None) and (expected is None or re.search(expected, texts[0]))


def test_processing_of_impossible_size(tmp_path):
    """Seconds between the samples, or a corner far below the record's length, would need gigabytes."""
    path = write(tmp_path, "a.csv", "# units: gal\n# dt: 1\nns\n" + "1\n2\n" * 50_000)
    with pytest.raises(RecordError, match="samples; at most 5e[+]06"):
        MotionRequest(record=str(path), resample=True).motion(2.5e-4)
    fast = write(tmp_path, "b.csv", "# units: gal\n# dt: 1e-4\nns\n" + "1\n2\n" * 50)
    with pytest.raises(RecordError, match="samples; at most 5e[+]06"):
        MotionRequest(record=str(fast), highpass=1e-3).motion(2.5e-4)


def test_missing_files(tmp_path):
    with pytest.raises(RecordError, match="no such file, and no three files"):
        read_motion(tmp_path / "nothing")
    knet_record(tmp_path)
    (tmp_path / "TST001.UD").unlink()
    with pytest.raises(RecordError, match="found only TST001.EW, TST001.NS"):
        read_motion(tmp_path / "TST001")
    with pytest.raises(RecordError, match="no such file"):
        read_motion(f"{tmp_path}/TST001.NS,{tmp_path}/TST001.UD")
    with pytest.raises(RecordError, match="is a folder"):
        read_motion(tmp_path)


def test_components_that_do_not_fit(tmp_path):
    a = write(tmp_path, "A000.AT2", at2_text(WAVES["ns"], "0"))
    short = write(tmp_path, "A090.AT2", at2_text(WAVES["ew"][:-3], "90"))
    slow = write(tmp_path, "B090.AT2", at2_text(WAVES["ew"], "90", "NPTS= {n}, DT= .01 SEC"))
    askew = write(tmp_path, "C045.AT2", at2_text(WAVES["ew"], "45"))
    with pytest.raises(RecordError, match="different length"):
        read_motion(f"{a},{short}")
    assert len(read_motion(f"{a},{short}", trim_to_shortest=True)) == len(
        MotionRequest(record=f"{a},{short}", shortest=True).motion(0.02)) == N - 3
    with pytest.raises(RecordError, match="time step 0.01 s; A000.AT2 has 0.02 s"):
        read_motion(f"{a},{slow}")
    with pytest.raises(RecordError, match="must be 90 apart"):
        read_motion(f"{a},{askew}")
    with pytest.raises(RecordError, match="2 directions for 1 components"):
        read_motion(a, component="ns,ew")


def test_ground_motion_refuses_nonsense():
    for dt, values in ((0.0, np.zeros((4, 3))), (0.01, np.zeros((4, 2))), (0.01, np.full((4, 3), np.nan))):
        with pytest.raises(RecordError):
            GroundMotion(dt, values)


# --- real records, where they are there ---------------------------------------------------------

RECORDS = os.environ.get("YADE_TIMBER_RECORDS")
real = pytest.mark.skipif(not RECORDS, reason="YADE_TIMBER_RECORDS names no folder with real records")

PUBLISHED = {
    "RSN1106_KOBE_KJM": {"ns": 818.1, "ew": 617.5, "ud": 332.4},
    "AOM0011801241951": {"ns": 4.954, "ew": 4.078, "ud": 2.240},
    "RSN6_IMPVALL.I_I-ELC180.AT2": {"ns": 275.4},
}


@real
@pytest.mark.parametrize("name, peaks", PUBLISHED.items(), ids=PUBLISHED.keys())
def test_real_records_have_their_published_peaks(name, peaks):
    got = read_motion(Path(RECORDS) / name).pga_gal
    digits = 3 if name.startswith("AOM") else 1
    assert {k: round(got[k], digits) for k in peaks} == peaks


def test_prefix_of_other_files_names_them(tmp_path):
    for name in ("RSN1_QQ", "RSN1_RR", "RSN2_XL", "RSN2_XT", "RSN2_XUP"):
        write(tmp_path, f"{name}.AT2", at2_text(WAVES["ns"], "somewhere"))
    with pytest.raises(RecordError, match="files of that beginning: RSN1_QQ.AT2, RSN1_RR.AT2"):
        read_motion(tmp_path / "RSN1_")
    with pytest.raises(RecordError, match="direction not stated"):
        read_motion(tmp_path / "RSN2_X")

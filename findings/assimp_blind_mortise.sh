#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# assimp 5.2.5 (Debian 12): an opening of an IFC beam is cut through the whole beam, however deep the file states it.
# Guess: a mortise of 90 x 30 mm, 5 or 55 mm deep, takes 13.5 or 148.5 cm3 from a beam of 100 x 200 mm.
# Seen: 540 cm3 in both cases, as much as a mortise through all 200 mm.
# Needs Debian 12 with apt-get and Python 3. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get -qq -o APT::Sandbox::User=root download assimp-utils=5.2.5~ds0-1+b1 libassimp5=5.2.5~ds0-1+b1 \
	libdraco7=1.5.5+dfsg-2
for package in *.deb; do dpkg -x "$package" .; done
cat >run.py <<'PY'
import glob, os, subprocess, sys

HEAD = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('ViewDefinition [CoordinationView]'),'2;1');
FILE_NAME('beam.ifc','2024-01-01T00:00:00',(''),(''),'','','');
FILE_SCHEMA(('IFC2X3'));
ENDSEC;
DATA;
"""
# A beam of 2 m along x, 100 mm wide (y) and 200 mm high (z), and an opening from z = {bottom} mm to above its top.
DATA = """IFCPERSON($,$,'a',$,$,$,$,$)
IFCORGANIZATION($,'a',$,$,$)
IFCPERSONANDORGANIZATION(#1,#2,$)
IFCAPPLICATION(#2,'1','a','a')
IFCOWNERHISTORY(#3,#4,$,.ADDED.,$,$,$,0)
IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)
IFCUNITASSIGNMENT((#6))
IFCCARTESIANPOINT((0.,0.,0.))
IFCDIRECTION((0.,0.,1.))
IFCDIRECTION((1.,0.,0.))
IFCDIRECTION((0.,1.,0.))
IFCAXIS2PLACEMENT3D(#8,#9,#10)
IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#12,$)
IFCPROJECT('0000000000000000000001',#5,'p',$,$,$,$,(#13),#7)
IFCLOCALPLACEMENT($,#12)
IFCBUILDING('0000000000000000000002',#5,'b',$,$,#15,$,$,.ELEMENT.,$,$,$)
IFCRELAGGREGATES('0000000000000000000003',#5,$,$,#14,(#16))
IFCLOCALPLACEMENT(#15,#12)
IFCCARTESIANPOINT((0.,0.))
IFCAXIS2PLACEMENT2D(#19,$)
IFCRECTANGLEPROFILEDEF(.AREA.,$,#20,100.,200.)
IFCAXIS2PLACEMENT3D(#8,#10,#11)
IFCEXTRUDEDAREASOLID(#21,#22,#9,2000.)
IFCSHAPEREPRESENTATION(#13,'Body','SweptSolid',(#23))
IFCPRODUCTDEFINITIONSHAPE($,$,(#24))
IFCBEAM('0000000000000000000004',#5,'beam',$,$,#18,#25,$)
IFCRELCONTAINEDINSPATIALSTRUCTURE('0000000000000000000005',#5,$,$,(#26),#16)
IFCCARTESIANPOINT((1000.,0.,{bottom}))
IFCAXIS2PLACEMENT3D(#28,#9,#10)
IFCLOCALPLACEMENT(#18,#29)
IFCRECTANGLEPROFILEDEF(.AREA.,$,#20,90.,30.)
IFCEXTRUDEDAREASOLID(#31,#12,#9,{height})
IFCSHAPEREPRESENTATION(#13,'Body','SweptSolid',(#32))
IFCPRODUCTDEFINITIONSHAPE($,$,(#33))
IFCOPENINGELEMENT('0000000000000000000006',#5,'mortise',$,$,#30,#34,$)
IFCRELVOIDSELEMENT('0000000000000000000007',#5,$,$,#26,#35)
"""
os.environ["LD_LIBRARY_PATH"] = os.path.dirname(glob.glob("usr/lib/*/libassimp.so.5")[0])


def removed(bottom):
    """Volume of the stated beam less that of the imported one. [cm3]"""
    lines = DATA.format(bottom=bottom, height=105 - bottom).splitlines()
    with open("beam.ifc", "w") as out:
        out.write(HEAD + "".join(f"#{k}={line};\n" for k, line in enumerate(lines, 1)) + "ENDSEC;\nEND-ISO-10303-21;\n")
    subprocess.run(["usr/bin/assimp", "export", "beam.ifc", "beam.stl", "-tri"], check=True, stdout=subprocess.DEVNULL)
    with open("beam.stl") as file:
        points = [tuple(map(float, line.split()[1:])) for line in file if line.split()[:1] == ["vertex"]]
    volume = 0
    for (ax, ay, az), (bx, by, bz), (cx, cy, cz) in zip(*[iter(points)] * 3):
        volume += ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)
    return 1e6 * (0.1 * 0.2 * 2 - volume / 6)


status = 0
for bottom, stated in ((95.0, "5 mm deep"), (45.0, "55 mm deep"), (-105.0, "through")):
    volume = removed(bottom)
    print(f"{stated}: {volume:.1f} cm3 removed, seen 540")
    status |= not abs(volume - 540) < 1
sys.exit(status)
PY
python3 run.py

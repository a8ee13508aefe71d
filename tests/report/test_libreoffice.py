"""The macros of the how-to in LibreOffice itself, without a window: a cell holds what Python predicts."""

import json
import re
import shutil
import subprocess
import sysconfig
from pathlib import Path
from xml.sax.saxutils import escape

import pytest

import stiction as st

PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "spreadsheets-and-languages.md"
SYSTEM = "/usr/bin/python3"  # LibreOffice's own: the one that has uno
CASE = """
contact.first = "copper"
contact.second = "copper"
contact.interface = "oxidised metal"
contact.roughness = { rms_height = "0.2 um", finish = "ground" }
contact.nominal_area = "1 cm^2"
solve.load = "10 N"
"""
MODULE = """<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE script:module PUBLIC "-//OpenOffice.org//DTD OfficeDocument 1.0//EN" "module.dtd">
<script:module xmlns:script="http://openoffice.org/2000/script" script:name="Module1" script:language="StarBasic">{}
</script:module>
"""
DRIVE = """
import json, subprocess, sys, time, uno
profile, pipe, formulas = sys.argv[1], sys.argv[2], json.loads(sys.argv[3])
office = subprocess.Popen(["soffice", "--headless", "--norestore", "-env:UserInstallation=file://" + profile,
                           "--accept=pipe,name=" + pipe + ";urp;"])
here = uno.getComponentContext()
resolver = here.ServiceManager.createInstanceWithContext("com.sun.star.bridge.UnoUrlResolver", here)
for _ in range(120):
    try:
        there = resolver.resolve("uno:pipe,name=" + pipe + ";urp;StarOffice.ComponentContext")
        break
    except Exception:
        time.sleep(0.5)
desktop = there.ServiceManager.createInstanceWithContext("com.sun.star.frame.Desktop", there)
book = desktop.loadComponentFromURL("private:factory/scalc", "_blank", 0, ())
cells = book.Sheets[0]
cells[0, 0].Value = 1000
found = []
for row, formula in enumerate(formulas):
    cells[row, 1].Formula = formula
    found.append(cells[row, 1].Value or cells[row, 1].String)
book.close(True)
desktop.terminate()
office.wait(30)
print(json.dumps(found))
"""


def has_uno():
    return (
        shutil.which("soffice")
        and subprocess.run([SYSTEM, "-c", "import uno"], capture_output=True, check=False).returncode == 0
    )


@pytest.mark.skipif(not has_uno(), reason="LibreOffice with Python macros is not installed")
def test_a_cell_holds_the_prediction(tmp_path):
    blocks = re.findall(r"```(\w+)\n(.*?)```", PAGE.read_text(encoding="utf-8").partition("## LibreOffice Calc")[2], re.DOTALL)
    code = {language: text for language, text in reversed(blocks)}
    macro = code["py"].replace('Path.home().glob("stiction/lib/python3*/site-packages")', repr([sysconfig.get_path("purelib")]))
    user = tmp_path / "profile" / "user"
    first = ["soffice", "--headless", f"-env:UserInstallation=file://{user.parent}", "--terminate_after_init"]
    subprocess.run(first, check=True, capture_output=True, timeout=120)  # makes the profile
    for place, text in {
        "Scripts/python/stiction_cell.py": macro,
        "basic/Standard/Module1.xba": MODULE.format(escape(code["vbnet"])),
    }.items():
        (user / place).parent.mkdir(parents=True, exist_ok=True)
        (user / place).write_text(text, encoding="utf-8")
    case = tmp_path / "joint.toml"
    case.write_text(CASE, encoding="utf-8")
    formulas = [f'=STICTION("{name}";"case";"{case}";"load";A1)' for name in ("mu", "mu_low")] + ['=STICTION("mu";"load";10)']
    arguments = [SYSTEM, "-c", DRIVE, str(user.parent), f"stiction{tmp_path.stat().st_ino}", json.dumps(formulas)]
    done = subprocess.run(arguments, text=True, capture_output=True, check=True, timeout=300)
    *numbers, refused = json.loads(done.stdout.splitlines()[-1])
    expected = [st.predict_value(name, "case", str(case), "load", 1000.0) for name in ("mu", "mu_low")]
    assert numbers == pytest.approx(expected, rel=1e-9)
    assert refused.startswith("contact and indices")

# SPDX-License-Identifier: BSD-3-Clause
"""Analyses that are stopped and continued."""
import pathlib
import re
import signal
import subprocess
import time

from checks import expect, of_ranks
from stopped import FULL, ROOT, command, fresh, run


def stopped_analysis(signum, folder, plural, least, *arguments):
    """Starts an analysis and sends it a signal when it has stored a result; returns its exit
    code."""
    fresh(folder)
    process = subprocess.Popen(command(*arguments, "--output", folder), stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, env=of_ranks(1))
    while process.poll() is None and len(list(
            pathlib.Path(folder).glob(f"cache/{plural}_*.json"))) < least:
        time.sleep(0.005)
    process.send_signal(signum)
    return process.wait(timeout=60)


def analyses():
    """Interrupted or killed analyses are continued by the same command, end with the same tables,
    and print a message."""
    assembly, string = str(ROOT / "xml/bha_motor_1500m.xml"), str(ROOT / "xml/helical_170m.xml")
    bha = [
        word
        for name, value in (("Inclination", "{20 deg}"), ("Build Rate", "3 deg/30m"),
                            ("Weight On Bit", "{20 kN, 60 kN}"), ("Tool Face", "{0 deg, 90 deg}"),
                            ("Rotating Tool Faces", "3"), ("Element Length", "1"))
        for word in ("--set", f"Bottom-Hole Assembly/{name}={value}")
    ]
    shorter = "{pipe, last pipe, collar, stabiliser, bit}"
    campbell = [
        "--set", f"Drillstring/Assembly={shorter}", "--set", "Campbell/Highest Speed=120 rpm",
        "--set", "Campbell/Points=8", "--set", "Campbell/Modes=4"
    ]
    response = pathlib.Path("response.xml")
    text = (ROOT / "xml/helical_170m.xml").read_text(encoding="utf-8").replace(
        'value="components/', f'value="{ROOT}/xml/components/')
    text = re.sub('("Assembly".*value=)"[^"]*"', f'\\1"{shorter}"', text)
    place = ('<Parameter name="Node" type="int" value="12"/><Parameter name="Component" '
             'type="string" value="u"/>')
    response.write_text(
        text[:text.rindex("</ParameterList>")] + f"""<ParameterList name="Response">
        <Parameter name="Excitation" type="string" value="Harmonic"/>
        <Parameter name="Highest Frequency" type="double" value="4"/>
        <Parameter name="Points" type="int" value="121"/><ParameterList name="Loads">
        <ParameterList name="push">{place}<Parameter name="Value" type="double" value="100"/>
        </ParameterList></ParameterList><ParameterList name="Outputs">
        <ParameterList name="there">{place}</ParameterList></ParameterList></ParameterList>
        </ParameterList>""", encoding="utf-8")
    for name, plural, least, deck, options, tables in (
        ("bha", "states", 2, assembly, bha, ("bha", "bha_contacts", "bha_profile")),
        ("response", "points", 5, str(response), FULL, ("response", "peaks", "bending", "margins")),
        ("campbell", "speeds", 1, string, [*campbell, *FULL], ("campbell", "crossings")),
        ("buckling", "states", 1, str(ROOT / "xml/buckling_100m.xml"), [
            "--set", "Buckling/Last Weight On Bit=600 kN", "--set",
            "Drillstring/Components/pipe/Length=50", "--set",
            "Drillstring/Components/pipe/Elements=100"
        ], ("buckling", "buckling_profile")),
    ):

        def read(folder):
            return [pathlib.Path(folder, f"{table}.csv").read_bytes() for table in tables]

        arguments = (name, deck, *options)
        fresh("whole_table")
        whole = run(*arguments, "--output", "whole_table")
        expect(f"{name}: runs", whole.returncode == 0, whole.stderr[-300:])
        for how, code in ((signal.SIGINT, 130), (signal.SIGKILL, -9)):
            # on a busy machine a command may end before its signal
            for _ in range(5):
                found = stopped_analysis(how, "stopped_table", plural, least, *arguments)
                if found != 0:
                    break
            expect(f"{name}: {how.name} stops it", found == code, str(found))
            done = run(*arguments, "--output", "stopped_table")
            expect(f"{name}, {how.name}: it goes on and says so", done.returncode == 0
                   and f"{plural} are known from before" in done.stdout,
                   done.stdout[-300:] + done.stderr[-300:])
            expect(f"{name}, {how.name}: the same tables", done.returncode == 0
                   and read("stopped_table") == read("whole_table"))
        again = run(*arguments, "--output", "stopped_table", ranks=2)
        expect(
            f"{name}: two ranks know it, with the same tables",
            "are known from before" in again.stdout
            and read("stopped_table") == read("whole_table"), again.stderr[-300:])
        if name in ("response", "buckling"):  # the other analyses continue in the same two ways
            continue
        other = run(*arguments, "--output", "stopped_table", "--set", "Loads/Gravity=9.8")
        expect(
            f"{name}: another deck is computed anew, and that is said", other.returncode == 0
            and f"{plural} of another deck" in " ".join(other.stdout.split())
            and read("stopped_table") != read("whole_table"), other.stdout[-300:])
        forgotten = run(*arguments, "--output", "stopped_table", "--fresh")
        expect(f"{name}: --fresh forgets", "known" not in forgotten.stdout
               and read("stopped_table") == read("whole_table"), forgotten.stdout[-300:])

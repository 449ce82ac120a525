#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Invalid files, impossible sizes and contradictory choices: check_inputs.py PROGRAM

Every file that a deck or a command line can name is replaced by a FIFO, a device and a terabyte of
zeros, and parts declare matrices that are missing. Each must be refused with a message, in seconds
and with little memory. `check` must refuse everything that `run` refuses without solving, with the
same exit code.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish  # noqa: E402

PROGRAM = sys.argv[1]
ROOT = pathlib.Path(__file__).resolve().parents[2]
FRAME = ROOT / "xml" / "frame.xml"
STRING = ROOT / "tests" / "effects" / "scene.xml"
SURVEY = ROOT / "examples" / "03_survey_well" / "deck.xml"
SECONDS = 60  # on a loaded machine; one on an idle machine
MEGABYTES = 400


def tooljoint(*arguments):
    """Exit code, standard error and peak memory [MB] of the program."""
    with open("said", "wb") as said:
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.DEVNULL,
                                   stderr=said)
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            done, status, usage = os.wait4(process.pid, os.WNOHANG)
            if done:
                process.returncode = os.waitstatus_to_exitcode(status)
                break
            time.sleep(0.02)
        else:
            process.kill()
            process.wait()
            return "timeout", "", 0.0
    return process.returncode, pathlib.Path("said").read_text(
        encoding="utf-8", errors="replace"), usage.ru_maxrss / 1024


def refused(what, code, sentence, *arguments):
    found, said, memory = tooljoint(*arguments)
    sentence = " ".join(sentence.split())
    expect(f"{what}: exit code {code}", found == code, f"(found {found}) {said[-500:]}")
    expect(f"{what}: says \"{sentence}\"", sentence in " ".join(said.split()), said[-500:])
    expect(f"{what}: takes no memory", memory < MEGABYTES, f"({memory:.0f} MB)")


def part(folder, **changes):
    """A part of two dofs as part.json and matrices, with changes in the JSON."""
    pathlib.Path(folder).mkdir(exist_ok=True)
    text = "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2\n2 2 2\n2 1 -1\n"
    pathlib.Path(folder, "K.mtx").write_text(text, encoding="utf-8")
    pathlib.Path(folder, "M.mtx").write_text(text.replace("-1", "0.5"), encoding="utf-8")
    content = {
        "format": "tooljoint part 1", "components": ["u"], "dofs": [[1, "u"], [2, "u"]],
        "mass": "M.mtx", "stiffness": "K.mtx", **changes
    }
    pathlib.Path(folder, "part.json").write_text(json.dumps(content), encoding="utf-8")
    return pathlib.Path(folder)


def deck_of(file, name="part.xml"):
    pathlib.Path(name).write_text(
        '<ParameterList name="s"><ParameterList name="Parts"><ParameterList name="Imported">'
        f'<ParameterList name="a"><Parameter name="File" type="string" value="{file}"/>'
        '</ParameterList></ParameterList></ParameterList></ParameterList>', encoding="utf-8")
    return name


def special_files():
    os.mkfifo("pipe")
    os.mkfifo("pipe.json")
    for file, kind in (("pipe", "a FIFO"), ("/dev/zero", "a device")):
        file = str(pathlib.Path(file).resolve()) if file == "pipe" else file
        sentence = f"{file} cannot be read: it is no regular file, but {kind}."
        refused(f"deck {file}", 5, sentence, "check", file)
        refused(f"survey {file}", 2, sentence, "check", SURVEY, "--set", f"Well/Survey/File={file}")
        refused(f"library {file}", 2, sentence, "check", STRING, "--set",
                f"Drillstring/Library={file}")
        refused(f"part {file}", 2, sentence, "check", deck_of(file))
        refused(f"matrix {file}", 2, sentence, "check", deck_of(part("matrix", stiffness=file)))
        refused(f"positions {file}", 2, sentence, "check",
                deck_of(part("positions", positions=file)))
        refused(f"user vectors {file}", 2, sentence, "check", STRING, "--set",
                "Reduction/Basis=User Vectors", "--set", f"Reduction/User Vectors/File={file}",
                "--without", "Reduction/Load Vectors")
        pathlib.Path("results").mkdir(exist_ok=True)
        pathlib.Path("results/results.h5").unlink(missing_ok=True)
        pathlib.Path("results/results.h5").symlink_to(file)
        refused(f"results {file}", 5, f"cannot be read: it is no regular file, but {kind}.",
                "compare", "results", "results")
    refused("part pipe.json", 2, "it is no regular file, but a FIFO.", "check",
            deck_of("pipe.json"))


def without_end():
    for name in ("huge.csv", "huge.mtx", "huge.json", "huge.h5", "huge.xml"):
        with open(name, "wb") as file:
            file.truncate(1 << 40)
    path = pathlib.Path().resolve()
    refused("deck of a terabyte", 2, "is larger than 64 MB, which cannot be a deck.", "check",
            "huge.xml")
    refused("survey of a terabyte", 2, "is larger than", "check", SURVEY, "--set",
            f"Well/Survey/File={path}/huge.csv")
    refused("library of a terabyte", 2, "is larger than 64 MB", "check", STRING, "--set",
            f"Drillstring/Library={path}/huge.xml")
    refused("part of a terabyte", 2, "is larger than", "check", deck_of("huge.json"))
    refused("HDF5 part of a terabyte", 2, "is not a part file", "check", deck_of("huge.h5"))
    refused("matrix of a terabyte", 2, "has a line of more than 1024 characters", "check",
            deck_of(part("matrix", stiffness=str(path / "huge.mtx"))))


def hdf5_part(name, write):
    with h5py.File(name, "w") as file:
        file.attrs["format"] = "tooljoint part 1"
        file["components"] = np.array(["u"], dtype=h5py.string_dtype())
        if write is not huge_dofs:
            file["dofs"] = np.array([[1, 1], [2, 1]])
        if write is not huge_matrix:
            file["mass"] = np.eye(2)
        file["stiffness"] = np.array([[2.0, -1], [-1, 2]])
        write(file)
    return deck_of(name)


def huge_dofs(file):
    file.create_dataset("dofs", shape=(10**12, 2), dtype="i4", chunks=(1024, 2))


def huge_matrix(file):
    file.create_dataset("mass", shape=(10**9, 10**9), dtype="f8", chunks=(64, 64))


def huge_shape(file):
    group = file.create_group("damping")
    group["row"], group["column"], group["value"], group["shape"] = [0], [0], [1.0], [
        4 * 10**9, 4 * 10**9
    ]


def huge_texts(file):
    file.create_dataset("omitted", shape=(10**10,), dtype="S1000000", chunks=(1,))


def external(file):
    file.create_dataset("damping", shape=(2, 2), dtype="f8",
                        external=[("/dev/zero", 0, h5py.h5f.UNLIMITED)])


def foreign_filter(file):
    file.create_dataset("damping", data=np.eye(2), compression="lzf")


def many_names(file):
    file.attrs["name"] = np.array(["a"] * 50, dtype=h5py.string_dtype())


def announced_sizes():
    for write, sentence in (
        (huge_dofs, "announces 2e+12 values in /dofs"),
        (huge_matrix, "announces 1e+18 values in /mass"),
        (huge_shape, "\"damping/shape\" holds 4e+09, expected rows and columns from 1 to 16777216"),
        (huge_texts, "announces 1e+10 values in /omitted"),
        (external, "has the values of /damping in other files"),
        (foreign_filter, "has /damping compressed by \"lzf\", which this program cannot undo"),
        (many_names, "text in the attribute name"),
    ):
        refused(f"HDF5 part with {write.__name__}", 2, sentence, "check",
                hdf5_part(f"{write.__name__}.h5", write))
    head = "%%MatrixMarket matrix coordinate real general\n"
    for what, text, sentence in (
        ("entries", head + "2 2 1000000000000\n1 1 1\n", "announces 1000000000000 entries"),
        ("rows", head + "1000000000 1000000000 1\n1 1 1\n",
         "with at most 16777216 rows and columns"),
    ):
        pathlib.Path(f"{what}.mtx").write_text(text, encoding="utf-8")
        refused(f"matrix that announces {what}", 2, sentence, "check",
                deck_of(part("matrix", stiffness=str(pathlib.Path(f"{what}.mtx").resolve()))))
    pathlib.Path("wide.mtx").write_text(head + "10000000 1000000 1\n1 1 1\n", encoding="utf-8")
    refused("wide positions", 2, "too large for a dense matrix", "check",
            deck_of(part("positions", positions=str(pathlib.Path("wide.mtx").resolve()))))


def many_attributes():
    attributes = "".join(f' a{i}="1"' for i in range(100000))
    pathlib.Path("attributes.xml").write_text(
        f'<ParameterList name="s">\n<Parameter{attributes}/>\n</ParameterList>', encoding="utf-8")
    refused("100,000 attributes", 2, "attributes.xml:2: an element has more than 100 attributes",
            "check", "attributes.xml")


def check_refuses_what_run_refuses():
    """One row: the deck, its change, and the message of both commands. The exit codes are the
    same."""
    dual = ["--set", "Reduction/Basis=Dual Craig-Bampton"]
    macneal = ["--set", "Reduction/Basis=MacNeal"]
    calm = ["--without", "Parts/Starts"]
    explicit = ["--set", "Transient/Integrator=RK4", "--without", "Transient/Step"]
    short = ["--set", "Transient/End Time=0.01"]
    mass = [
        "--without", "Reduction/Mode Selection", "--set",
        "Reduction/Mode Selection/Effective Interface Mass=0.5"
    ]
    hooked = "hooked.xml"  # a spring instead of a support
    text = STRING.read_text(encoding="utf-8").rstrip().removesuffix("</ParameterList>")
    pathlib.Path(hooked).write_text(
        text +
        """<ParameterList name="Coupling"><ParameterList name="Springs"><ParameterList name="hook">
        <Parameter name="First" type="string" value="pipe 1:1"/>
        <Parameter name="Component" type="string" value="w"/>
        <Parameter name="Stiffness" type="double" value="1e6"/></ParameterList></ParameterList>
        </ParameterList></ParameterList>""", encoding="utf-8")
    rows = [
        (STRING, ["--set",
                  "Supports/Top=u v theta_z"], "The string floats: w is free at all of its"),
        (STRING, ["--set", "Supports/Top=w"], "The string floats: theta_z is free at all of its"),
        (STRING, [
            "--set", "Supports/Top=none", "--set", "Well/Trajectory=Vertical", "--set",
            "Well/Vertical/Length=60"
        ], "The string floats: it has no support."),
        (hooked, ["--set", "Supports/Top=u v theta_z"],
         "Springs of the list Coupling count from the static state"),
        (FRAME, [*macneal, *calm, *explicit], "is \"MacNeal\", which has a singular mass matrix, "
         "but the integrator \"RK4\" needs a nonsingular one"),
        (FRAME, [*dual, *calm,
                 *explicit], "is \"Dual Craig-Bampton\", which has a singular mass matrix"),
        (FRAME, [*macneal, "--set", "Reduction/Error Estimate=Frequencies"],
         "Error Estimate needs an error estimate, but the basis \"MacNeal\""),
        (FRAME, [
            *dual, "--set", "Reduction/Interface Reduction=System", "--set",
            "Reduction/System/Modes=3"
        ], "joins parts by interface forces"),
        (FRAME, [
            *macneal, "--set", "Reduction/Interface Reduction=System", "--set",
            "Reduction/System/Modes=3"
        ], "leaves them none"),
        (FRAME, [*dual, "--set", "Output/Export Parts=HDF5"],
         "cannot export parts of the basis \"Dual Craig-Bampton\""),
        (FRAME, [*macneal, "--set",
                 "Reduction/Load Vectors=Loads"], "cannot be added to the basis \"MacNeal\""),
        (FRAME, ["--set", "Reduction/Basis=Rubin", *mass],
         "selects fixed-interface modes one by one, but the basis \"Rubin\" has none"),
        (FRAME,
         ["--set", "Reduction/Basis=Enhanced Craig-Bampton", "--set",
          "Coupling/Assembly=Dual"], "needs the inverse of the coupled mass"),
        (FRAME, [
            "--set", "Reduction/Basis=Enhanced Craig-Bampton", "--set",
            "Reduction/Error Estimate=Both"
        ], "estimates the error of the motion, which is not available with"),
        (FRAME, ["--set", "Coupling/Assembly=Dual", "--set", "Reduction/Error Estimate=Transient"],
         "which is not available with Coupling/Assembly \"Dual\""),
        (FRAME,
         ["--set", "Reduction/Load Vectors=Points", "--set", "Reduction/Load Vector Nodes={9999}"
          ], "names node 9999, but no substructure has a point law there"),
        (FRAME, ["--set", "Transient/Step=1e-300"], "which gives 2e+300 intervals"),
        (FRAME, ["--set",
                 "Transient/Sampling Interval=1e-300"], "which gives 2e+300 intervals in the 2 s"),
        (deck_of(part("strange", positions=[[1, 0, 0, 0], [9, 0, 0, 0]]),
                 "strange.xml"), [], "names node 9 in row 2, which the part does not have"),
        (deck_of(part("number", name=7), "number.xml"), [], "\"name\" must be a text"),
    ]
    for deck, changes, sentence in rows:
        motion = short if deck == FRAME and not any("Transient/" in one for one in changes) else []
        ran = tooljoint("run", deck, *changes, *motion, "--output", "refused")
        checked = tooljoint("check", deck, *changes, *motion)
        what = " ".join(changes) or str(deck)
        expect(f"{what}: check ends as run does", ran[0] == checked[0] and checked[0] in (2, 3),
               f"(run {ran[0]}, check {checked[0]})")
        expect(
            f"{what}: both say why",
            all(" ".join(sentence.split()) in " ".join(one[1].split()) for one in (ran, checked)),
            f"run: {ran[1][-300:]} check: {checked[1][-300:]}")
    # Interface dofs are left to the modes: check must predict the outcome of this start in a run.
    ran, checked = tooljoint("run", FRAME, *dual, *short, "--output",
                             "refused"), tooljoint("check", FRAME, *dual, *short)
    expect("a dual basis with a start: check ends as run does", ran[0] == checked[0],
           f"(run {ran[0]}, check {checked[0]}) {ran[1][-300:]}")


def absurd_counts_are_told():
    """The size of a too long motion is printed as one number of three digits."""
    done = subprocess.run(
        [PROGRAM, "check", str(STRING), "--set", "Transient/End Time=500000"],
        stdout=subprocess.PIPE, text=True, check=False)
    line = next((one for one in done.stdout.splitlines() if "samples, about" in one), "")
    expect("the size of the results is told shortly", done.returncode == 0 and 0 < len(line) < 80,
           line)


def a_mistyped_depth_is_told():
    """A station is 1 m below the previous one instead of 60 m: the well would have a radius of
    curvature of 5 m."""
    text = (SURVEY.parent / "survey.csv").read_text(encoding="utf-8")
    sentence = "sharper than wells are drilled: check the depths and angles there"
    for name, depth, told in (("as it is", "180", False), ("mistyped", "121", True)):
        pathlib.Path("survey.csv").write_text(text.replace("\n180,", f"\n{depth},"),
                                              encoding="utf-8")
        said = subprocess.run([
            PROGRAM, "check",
            str(SURVEY), "--set", f"Well/Survey/File={pathlib.Path('survey.csv').resolve()}"
        ], stdout=subprocess.PIPE, text=True, check=False).stdout
        expect(f"a survey {name} has its largest dogleg judged",
               (sentence in " ".join(said.split())) == told, said[-500:])


BIT_AT_A_STATION = """<ParameterList name="kink">
  <ParameterList name="Well">
    <Parameter name="Trajectory" type="string" value="Survey"/>
    <ParameterList name="Survey">
      <Parameter name="Stations" type="Array(double)" value="{0, 0, 0, 300, 3, 0, 400, 53, 0}"/>
    </ParameterList>
    <Parameter name="Bore Diameter" type="string" value="8.5 in"/>
  </ParameterList>
  <ParameterList name="Drillstring">
    <Parameter name="Bit Depth" type="string" value="300 m"/>
    <Parameter name="Assembly" type="Array(string)" value="{fill*pipe}"/>
    <ParameterList name="Components">
      <ParameterList name="pipe">
        <Parameter name="Length" type="string" value="10 m"/>
        <Parameter name="Elements" type="int" value="2"/>
        <Parameter name="Outer Diameter" type="string" value="5 in"/>
        <Parameter name="Inner Diameter" type="string" value="4.276 in"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
</ParameterList>
"""


def a_dogleg_below_the_bit_is_not_counted():
    """The string bends by 3 deg in 300 m; 15 deg/30 m begin where it ends."""
    pathlib.Path("kink.xml").write_text(BIT_AT_A_STATION, encoding="utf-8")
    said = subprocess.run([PROGRAM, "check", "kink.xml"], stdout=subprocess.PIPE, text=True,
                          check=False).stdout
    expect("the dogleg of a string is that of its own interval", "largest dogleg 0.3 deg/30 m"
           in " ".join(said.split()), said[:600])


def main():
    shutil.rmtree("inputs", ignore_errors=True)  # of an earlier run of this test
    pathlib.Path("inputs").mkdir()
    os.chdir("inputs")
    special_files()
    without_end()
    announced_sizes()
    many_attributes()
    check_refuses_what_run_refuses()
    absurd_counts_are_told()
    a_mistyped_depth_is_told()
    a_dogleg_below_the_bit_is_not_counted()
    return finish()


if __name__ == "__main__":
    sys.exit(main())

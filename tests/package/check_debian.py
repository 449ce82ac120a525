#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The Debian packages of a build: check_debian.py CPACK BUILD VERSION CMAKE

Packs the build as docs/first-report.md does, installs the packages with dpkg into an empty root,
maintainer scripts included, and uses them there: the program makes a folder and runs its deck, the
commands of docs/first-report.md produce a report, the installed report tool works, a client is
built with the headers and runs, Python imports its package and computes. The libraries of the
distribution are those of this machine. If Lintian is installed, it finds no error.
"""
import gzip
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import stranger  # noqa: E402
from checks import expect, finish, of_ranks  # noqa: E402

CPACK, BUILD, VERSION, CMAKE = sys.argv[1:5]
CLIENT = pathlib.Path(__file__).resolve().parent
PYTHON = list(pathlib.Path(BUILD).glob("python/tooljoint/_core*.so"))
NAMES = ["tooljoint", "libtooljoint-dev"] + ["python3-tooljoint"] * len(PYTHON)
PROJECT = CLIENT.parents[1]
SOURCES, ROOT = pathlib.Path("tooljoint").resolve(), pathlib.Path("root").resolve()
PACKED = SOURCES / "packages"


def command(*words, **options):
    return subprocess.run([str(word) for word in words], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, check=False, timeout=240, **options)


def pack():
    """The files of the packages by their name, made by the first commands of docs/first-report.md
    without the build, which exists."""
    for folder in (SOURCES, ROOT):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
    (SOURCES / "build").mkdir()
    (SOURCES / "build/release").symlink_to(BUILD)
    enter, build, *packing = stranger.before_installation()
    shown = command(PROJECT / "quickstart", "help").stderr
    expect(f"{build} builds",
           re.search(rf"^  {re.escape(build)} +only builds the program$", shown, re.M), shown)
    done = command("bash", "-euc", "\n".join([enter, *packing]), cwd=SOURCES.parent,
                   env={**os.environ, "PATH": f"{pathlib.Path(CPACK).parent}:{os.environ['PATH']}"})
    found = {path.name.split("_")[0]: path for path in PACKED.glob("*.deb")}
    expect(f"{packing[-1]} makes {', '.join(NAMES)}", done.returncode == 0
           and set(found) == set(NAMES), done.stdout[-600:] + done.stderr[-600:])
    expect(
        "the page installs the program from there",
        stranger.installed(SOURCES) == [found["tooljoint"].name] if "tooljoint" in found else False,
        stranger.installed(SOURCES))
    return found


def control(package):
    """Fields of the control file; continued lines are joined."""
    text = command("dpkg-deb", "-f", package).stdout
    return dict(re.findall(r"^([\w-]+): (.*(?:\n .*)*)", text, re.M))


def fields(packages):
    program, dev, *python = (control(packages[name]) for name in NAMES)
    needed = {word.strip().split(" ")[0] for word in program.get("Depends", "").split(",")}
    wanted = ("libc6", "libstdc++6", "libopenmpi", "libhdf5-openmpi", "libmumps", "libxml2",
              "libtrilinos-tpetra", "libtrilinos-nox", "libtrilinos-amesos2")
    expect("the program depends on the libraries it is linked to",
           all(any(name.startswith(word) for name in needed) for word in wanted),
           str(sorted(needed)))
    expect("and on no package of headers", not any(name.endswith("-dev") for name in needed),
           str(sorted(needed)))
    expect(
        "its report is recommended", "python3-h5py" in program.get("Recommends", "")
        and "libjs-three" in program.get("Recommends", ""))
    expect(
        "the headers depend on this program", f"tooljoint (= {VERSION})" in dev.get("Depends", "")
        and "trilinos-all-dev" in dev["Depends"], dev.get("Depends"))
    for one in python:
        expect(
            "the Python package depends on this program, on its Python and on scipy",
            all(word in one.get("Depends", "")
                for word in (f"tooljoint (= {VERSION})", "python3 (>= 3.", "python3 (<< 3.",
                             "python3-scipy")), one.get("Depends"))
    for name, one in zip(NAMES, (program, dev, *python)):
        expect(
            f"{name}: name, version, maintainer and description", one["Package"] == name
            and one["Version"] == VERSION and "@" in one["Maintainer"]
            and len(one["Description"].splitlines()) > 2, str(one))


SHIM = """#!/bin/sh
# Scripts of maintainers call ldconfig without a path; it stays in the root they are for.
test -n "$DPKG_ROOT" || exit 1
echo "$DPKG_ROOT" >> {called}
exec /sbin/ldconfig -r "$DPKG_ROOT" "$@"
"""


def install(packages):
    """dpkg unpacks and configures all packages in an empty root; the library cache of the machine
    is not changed."""
    for folder in ("var/lib/dpkg/info", "var/lib/dpkg/updates", "var/lib/dpkg/triggers", "etc"):
        (ROOT / folder).mkdir(parents=True)
    for file in ("var/lib/dpkg/status", "var/lib/dpkg/available", "etc/ld.so.conf"):
        (ROOT / file).touch()
    called, tools = pathlib.Path("ldconfig_calls").resolve(), pathlib.Path("tools").resolve()
    called.unlink(missing_ok=True)
    tools.mkdir(exist_ok=True)
    (tools / "ldconfig").write_text(SHIM.format(called=called), encoding="utf-8")
    (tools / "ldconfig").chmod(0o755)
    cache = pathlib.Path("/etc/ld.so.cache")
    before = cache.stat().st_mtime_ns
    environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}:/usr/sbin:/sbin"}
    owner = [] if os.geteuid() == 0 else ["fakeroot"]
    done = command(*owner, "dpkg", f"--root={ROOT}", "--force-depends", "--force-script-chrootless",
                   "-i", *packages.values(), env=environment)
    expect("dpkg installs the packages", done.returncode == 0,
           done.stdout[-600:] + done.stderr[-600:])
    states = command("dpkg-query", f"--admindir={ROOT}/var/lib/dpkg", "-W", "-f",
                     "${Package} ${db:Status-Status}\n").stdout.splitlines()
    expect("all of them are set up",
           sorted(states) == sorted(f"{name} installed" for name in NAMES), str(states))
    expect(
        "their scripts have run ldconfig in that root alone",
        called.is_file() and set(called.read_text().split()) == {str(ROOT)}
        and (ROOT / "etc/ld.so.cache").is_file() and cache.stat().st_mtime_ns == before,
        called.read_text() if called.is_file() else "no call")


def unpack(packages):
    install(packages)
    for name in NAMES:
        folder = ROOT / "usr/share/doc" / name
        copyright_ = (folder / "copyright").read_text(encoding="utf-8")
        expect(
            f"{name}: copyright", "License: BSD-3-clause" in copyright_
            and "Redistribution and use" in copyright_ and "\n\n \n" not in copyright_)
        changes = gzip.decompress((folder / "changelog.gz").read_bytes()).decode()
        expect(f"{name}: changelog", changes.startswith(f"tooljoint ({VERSION}) "), changes)
    page = gzip.decompress((ROOT / "usr/share/man/man1/tooljoint-run.1.gz").read_bytes()).decode()
    expect("manual pages, compressed", ".SH SYNOPSIS" in page
           and not list(ROOT.glob("usr/share/man/man1/*.1")))
    for path in ("usr/share/bash-completion/completions/tooljoint",
                 "usr/share/zsh/vendor-completions/_tooljoint",
                 "usr/share/tooljoint/docs/user-manual.md"):
        expect(f"{path} is there", (ROOT / path).is_file())


def use():
    libraries = next(ROOT.glob("usr/lib/**/libtooljoint_toolkit.so.*")).parent
    environment = {**of_ranks(1), "LD_LIBRARY_PATH": str(libraries), "TOOLJOINT_REPORT": "off"}
    program = ROOT / "usr/bin/tooljoint"
    for file in (program, *ROOT.glob("usr/lib/python3/dist-packages/tooljoint/_core*.so"),
                 *(path
                   for path in libraries.glob("libtooljoint_*.so.*") if not path.is_symlink())):
        paths = re.findall(r"\((?:RPATH|RUNPATH)\)", command("readelf", "-d", file).stdout)
        expect(f"{file.name}: no path of this machine in it", not paths, str(paths))
    loaded = command("ldd", program, env=environment).stdout
    own = re.findall(r"libtooljoint_\S+ => (\S+)", loaded)
    expect(
        "its libraries are those of the package, and none is missing", "not found" not in loaded
        and len(own) == 2 and all(pathlib.Path(path).parent == libraries for path in own), loaded)
    version = command(program, "--version", env=environment)
    expect("tooljoint --version", version.returncode == 0
           and version.stdout.startswith(f"tooljoint {VERSION}"), version.stderr)
    shutil.rmtree("my_well", ignore_errors=True)
    made = command(program, "new", "my_well", env=environment)
    done = command(program, "run", "my_well.xml", "--without", "Transient", env=environment,
                   cwd="my_well") if made.returncode == 0 else made
    expect(
        "a new deck runs", done.returncode == 0 and json.loads(
            pathlib.Path("my_well/results/my_well/summary.json").read_text(
                encoding="utf-8"))["status"] == "finished", done.stderr[-400:])
    reported = {name: value for name, value in environment.items() if name != "TOOLJOINT_REPORT"}
    stranger.on_files({**reported, "PATH": f"{program.parent}:{os.environ['PATH']}"},
                      pathlib.Path("stranger").resolve())
    told = command(program, "report", "nowhere", env=environment)
    expect("the report of the package answers", told.returncode == 5
           and '"nowhere" is no folder' in told.stderr, told.stderr)


def develop():
    """A client finds the installed headers, is built with them, and runs."""
    done = command(CMAKE, "-S", CLIENT, "-B", "client", "--fresh", "-D",
                   f"CMAKE_PREFIX_PATH={ROOT}/usr", "-D", "CMAKE_BUILD_TYPE=None", env=os.environ)
    cache = pathlib.Path("client/CMakeCache.txt").read_text(
        encoding="utf-8") if done.returncode == 0 else ""
    expect("a client finds the package", f"Tooljoint_DIR:PATH={ROOT}/usr/lib" in cache,
           done.stderr[-600:])
    built = command(CMAKE, "--build", "client", env=os.environ)
    libraries = next(ROOT.glob("usr/lib/**/libtooljoint_toolkit.so.*")).parent
    done = command("client/client", env={**of_ranks(1), "LD_LIBRARY_PATH": str(libraries)
                                         }) if built.returncode == 0 else built
    expect("it is built with the headers of the package and runs", done.returncode == 0,
           done.stdout[-600:] + done.stderr[-600:])


def use_python():
    """Imports the package from the root with the interpreter for which it was built, which runs
    this test."""
    libraries = next(ROOT.glob("usr/lib/**/libtooljoint_toolkit.so.*")).parent
    folder = ROOT / "usr/lib/python3/dist-packages"
    done = command(
        sys.executable, "-B", CLIENT.parent / "python/check_installed.py", folder,
        env={**of_ranks(1), "LD_LIBRARY_PATH": str(libraries), "PYTHONPATH": str(folder)})
    expect("Python imports its package and computes", done.returncode == 0, done.stderr[-600:])


def judge(packages):
    if not shutil.which("lintian"):
        print("lintian is not installed: not run")
        return
    done = command("lintian", "--allow-root", "--fail-on", "error", *packages.values())
    expect("lintian finds no error", done.returncode == 0, done.stdout[-2000:] + done.stderr[-300:])


def main():
    packages = pack()
    if len(packages) == len(NAMES):
        fields(packages)
        unpack(packages)
        use()
        develop()
        if PYTHON:
            use_python()
        judge(packages)
    return finish()


if __name__ == "__main__":
    sys.exit(main())

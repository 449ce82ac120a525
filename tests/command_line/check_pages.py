#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Manual pages and completions against the help of the program: check_pages.py PROGRAM PAGES

PAGES is the folder of the pages in the build. The options and words in the help of a command must
be in its page, in the page of the program and in both completions, and the pages must have no
others. If man and zsh are installed, man formats the pages and zsh reads its function. Parameters
that the manual shows first must be in a deck, an example or a tool.
"""
import functools
import json
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish, tooljoint  # noqa: E402

PAGES = pathlib.Path(sys.argv[2])
PROJECT = pathlib.Path(__file__).resolve().parents[2]
OPTION = re.compile(r"^  ((?:-\w,)?--[\w-]+|-\w)\b", re.M)


def commands():
    return re.findall(r"^  ([a-z][a-z-]*) ", tooljoint("--help").stdout, re.M)


@functools.lru_cache(maxsize=None)
def options(*words):
    """Spellings of all options of a help, and its positional words."""
    text = tooljoint(*words, "--help").stdout
    positional = re.findall(r"^  ([A-Z]+) ", text, re.M)
    return [name for group in OPTION.findall(text) for name in group.split(",")], positional


def plain(path):
    """The text of a manual page without font requests."""
    return re.sub(r"\\f[BIR]", "", path.read_text(encoding="utf-8")).replace("\\-", "-")


def spelled(text):
    """Options that begin an entry of a page."""
    return {
        name for line in re.findall(r"^\.TP\n(-.*)$", text, re.M)
        for name in re.findall(r"(?<![\w-])--?[\w-]+", line)
    }


def manual(names):
    whole = plain(PAGES / "man/man1/tooljoint.1")
    found = sorted(path.name for path in (PAGES / "man/man1").iterdir())
    expect("a page for the program and for each command",
           found == sorted(["tooljoint.1", *(f"tooljoint-{name}.1" for name in names)]), str(found))
    for name in names:
        own, positional = options(name)
        page = plain(PAGES / f"man/man1/tooljoint-{name}.1")
        expect(f"{name}: its page has the options of its help",
               spelled(page) == set(own) and len(own) > 1, f"{spelled(page) ^ set(own)}")
        expect(f"{name}: and its words", positional
               and all(f".TP\n{word}\n" in page for word in positional), str(positional))
        section = whole[whole.index(f".SS tooljoint {name} "):].split("\n.SS ")[0].split(
            "\n.SH ")[0]
        expect(f"{name}: the page of the program has them, too",
               spelled(section) == set(own), f"{spelled(section) ^ set(own)}")
    for code in (0, 1, 2, 3, 4, 5, 70, 130):
        expect(f"exit code {code} stands in the page", f".TP\n{code}\n" in whole)
    if shutil.which("man"):
        for path in (PAGES / "man/man1").iterdir():
            set_by_man = subprocess.run(
                ["man", "--warnings", "-E", "UTF-8", "-l",
                 str(path)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False,
                env={"MANWIDTH": "100", "PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8"})
            expect(
                f"{path.name}: man sets it without a warning", set_by_man.returncode == 0
                and set_by_man.stderr == "" and "EXIT STATUS" in set_by_man.stdout,
                set_by_man.stderr[:300])


def completed(*words):
    """Completions by bash of the last of the words."""
    script = (
        'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _tooljoint; '
        'printf "%s\\n" "${COMPREPLY[@]}"')
    done = subprocess.run([
        "bash", "-c", script, "bash",
        str(PAGES / "bash-completion/completions/tooljoint"), "tooljoint", *words
    ], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    expect(f"bash: tooljoint {' '.join(words)}: no error", done.stderr == "", done.stderr)
    return done.stdout.split("\n")[:-1]


def bash(names):
    expect("bash: all commands",
           [word for word in completed("") if not word.startswith("-")] == names,
           str(completed("")))
    expect("bash: commands that begin so", completed("to") == ["torque-drag"], str(completed("to")))
    for name in names:
        offered = completed(name, "-")
        expect(f"bash: options of {name}", set(offered) == set(options(name)[0]), f"{offered}")
    for folder in ("deck.xml", "drawings"):
        shutil.rmtree(folder, ignore_errors=True)
    pathlib.Path("drawings").mkdir()
    deck = pathlib.Path("drive.xml")
    deck.write_text("", encoding="utf-8")
    expect("bash: files for a deck",
           sorted(completed("run", "dr")) == ["drawings", "drive.xml"], str(completed("run", "dr")))
    expect("bash: folders for results",
           completed("run", "drive.xml", "--output", "dr") == ["drawings"])
    expect("bash: values of a choice",
           sorted(completed("export", "--format", "")) == ["dmig", "extptfm", "hdf5", "mtx"])
    expect("bash: kinds of templates", "well" in completed("template", ""))


def zsh(names):
    path = PAGES / "zsh/vendor-completions/_tooljoint"
    text = path.read_text(encoding="utf-8")
    expect("zsh: the function is that of tooljoint", text.startswith("#compdef tooljoint\n"))
    for name in names:
        section = text[text.index(f"\n    {name})\n"):].split("\n      ;;")[0]
        found = set(re.findall(r"'\*(-{1,2}[\w-]+)\[", section))
        expect(f"zsh: {name} and its options", f"'{name}:" in text
               and found == set(options(name)[0]), f"{found}")
    if shutil.which("zsh"):
        done = subprocess.run(["zsh", "-n", str(path)], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, check=False)
        expect("zsh reads it", done.returncode == 0 and done.stderr == "", done.stderr)


def refusals():
    for words, sentence in (
        (("doc", "nonsense", "--format", "man"),
         'There is no command "nonsense". Available: "doc", "new", '),
        (("doc", "run", "--format", "bash"), "The completion for bash covers all commands"),
    ):
        done = tooljoint(*words)
        expect(f"{' '.join(words)}: exit code 1", done.returncode == 1 and sentence in done.stderr,
               done.stderr)


def walked(described, path):
    """(path, parameter) of a list and those inside it."""
    yield from ((path, parameter) for parameter in described["parameters"])
    for inner in described["lists"]:
        yield from walked(inner, f"{path}{inner['name']}/")
    if described.get("named_lists"):
        yield from walked(described["named_lists"], f"{path}*/")


def levels():
    """A parameter that no deck, example or tool uses is an expert parameter, unless a user of its
    list must give it."""
    needed = {
        "Top Drive/Tuning Frequency",
        *(f"Coupling/{kind}/*/Second" for kind in ("Springs", "Stops", "Sliders", "Point Laws"))
    }
    files = [
        file for folder in ("xml", "examples", "tools", "python")
        for file in (PROJECT / folder).rglob("*")
        if file.suffix in (".xml", ".py", ".cpp", ".md", ".sh")
    ]
    shown = "\n".join(file.read_text(encoding="utf-8") for file in files)
    lists = json.loads(tooljoint("doc", "--format", "json").stdout)
    basic = [(f"{path}{parameter['name']}".partition("/")[2], parameter) for one in lists
             for path, parameter in walked(one, f"{one['name']}/") if parameter["level"] == "basic"]
    hidden = sorted({
        path for path, parameter in basic if not parameter["required"]
        and not re.search(rf"[\"'/]{re.escape(parameter['name'])}[\"'=]", shown)
    } - needed)
    expect("basic parameters are shown", len(basic) > 300 and not hidden, f"{len(basic)} {hidden}")


def main():
    names = commands()
    expect("the program has commands", len(names) > 10, str(names))
    manual(names)
    bash(names)
    zsh(names)
    refusals()
    levels()
    return finish()


if __name__ == "__main__":
    sys.exit(main())

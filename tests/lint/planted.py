# SPDX-License-Identifier: BSD-3-Clause
"""Sources that break the rules of lint.py, with the expected complaints: file -> (text, part of the
complaint), None if there is none."""
import repeats
import sizes

SPDX = "// SPDX-License-Identifier: BSD-3-Clause\n"
PYTHON = "#!/usr/bin/env python3\n# SPDX-License-Identifier: BSD-3-Clause\n"


def including(*headers):
    return SPDX + "".join(f'#include "{header}"\n' for header in headers)


BEAM, CASE, ROW = "substructures/beam/Section.hpp", "cases/Case.hpp", "study/Row.hpp"
TEXTS, TRANSIENT = "texts/Templates.hpp", "transient/Transient.hpp"
PATH = "substructures/path/PathState.hpp"
INCLUDES = {
    "src/io/A.cpp": (including(BEAM), "src/io may not include substructures/beam"),
    "src/io/B.cpp": (including("app/commands/Command.hpp"), "src/io may not include src/app"),
    "src/io/N.cpp": (including(CASE), "src/io may not include src/cases"),
    "src/cases/O.cpp": (including(ROW), "src/cases may not include src/study"),
    "src/study/P.cpp": (including(CASE), None),
    "src/texts/Z.cpp": (including(BEAM), "src/texts may not include substructures/beam"),
    "src/attic/U.cpp": (including("common/Error.hpp"), "is not in tests/lint/rooms.py"),
    "python/core/Z.cpp": (including(TEXTS), "python/core binds the toolkit"),
    "python/core/V.cpp": (including(BEAM), "python/core binds the toolkit"),
    "substructures/beam/F.cpp": (including(TRANSIENT),
                                 "substructures/beam may not include src/transient"),
    "substructures/beam/T.cpp": (including(PATH),
                                 "substructures/beam may not include substructures/path"),
    "substructures/drillstring/Q.cpp": (including(CASE),
                                        "substructures/drillstring may not include src/cases"),
    "substructures/drillstring/case/R.cpp": (including(CASE), None),
    "substructures/drillstring/case/S.cpp": (including(ROW), "may not include src/study"),
    "src/common/Words.hpp": (SPDX + "using Complex = std::complex<double>;\nint wordsOf(int a);\n",
                             None),
    "src/io/Lines.hpp": (including("common/Words.hpp"), None),
    "src/io/A1.cpp": (including("io/Lines.hpp") + "int a = wordsOf(1);\nComplex z;\n", None),
    "src/io/A2.cpp": (including("common/Error.hpp") + "// Complex\nComplex z(1);\n",
                      "A2.cpp:4: names Complex, but its includes do not reach common/Words.hpp"),
    "src/io/A3.cpp": (SPDX + "int a = wordsOf(1);\n", "A3.cpp:2: names wordsOf"),
    "src/io/A4.cpp": (SPDX + "struct Complex {};\nint a = b.wordsOf() + io::wordsOf(1);\n", None),
    "substructures/path/G.cpp": (including("model/PointLaw.hpp", BEAM) + "#include <vector>\n",
                                 None),
}
# Spelt so that this file does not contain them.
STRING, ASKED = "// a drill" + "string\n", "// nodes that are as" + "ked\n"
WORDS = {
    "src/io/C.cpp": (SPDX + STRING, "never heard"),
    "src/io/D.cpp": (SPDX + "// a Drill" + " pipe\n", "never heard"),
    "src/app/E.cpp": (including(BEAM) + STRING, None),
    "python/core/W.cpp": (including(ROW) + STRING, None),
    "src/io/N2.cpp": (SPDX + 'if (model.laws[i].name == "1") return;\n', "isOne()"),
    "tests/unit/a/H.cpp": ("int x;\n", "no SPDX"),
    "cmake/I.cmake": ("# SPDX-License-Identifier: BSD-3-Clause\n# TO" + "DO later\n", "says"),
    "docs/I1.md": ("The residual is " + "looked" + " at in each step.\n", "of a computation"),
    "src/io/I2.cpp": (SPDX + ASKED, "of a computation"),
    "tests/unit/a/I3.cpp": (SPDX + ASKED, None),
    "docs/J.md": ("see /wo" + "rk/main\n", "says"),
    "docs/K.md": ("this is not " + "implemented\n", "says"),
}
MEMBER = "  std::map<int, double> m{0}_{{1, 2}};\n  int f{0}(int a) const {{ return a; }}\n"
FULL = "class Full {\n" + "".join(MEMBER.format(i) for i in range(sizes.MEMBERS)) + "};\n"
WIDE = ("class Wide : public Base {\n int a_, b_ = 2;\n struct S {\n  int c;\n } s_;\n" +
        " std::function<void(int)> f_;\n" * (sizes.MEMBERS - 2) + "};\n")
PAGE = ("| app | 9,000 | all |\n\n## Recipes\n\n**A long one.**\n" + "a line\n" * sizes.RECIPE +
        "\n**A short one.**\n")
SIZES = {
    "src/io/W.hpp": (SPDX + FULL, None),
    "src/io/X.hpp": (SPDX + WIDE, "Wide has 26 data members"),
    "docs/architecture.md": (PAGE, ("lint.py --rooms", "a recipe of 21 lines",
                                    "says that app have 9,000 lines; they have 3")),
    "tests/unit/a/W.py": (PYTHON + "x = 1  # " + "a" * 91 + "\n", None),
    "tests/unit/a/W1.py": (PYTHON + "x = 1  # " + "a" * 92 + "\n", "has 101 columns"),
    **{f"src/crowd/V{i}.cpp": (SPDX, None) for i in range(sizes.FILES + 1)},
    "src/crowd": (None, "more than"),
}
LINES, LEAST = "".join(f"  a += {i};  // one\n" for i in range(repeats.LEAST)), repeats.LEAST
OVERRIDES = "".join(f"  int f{i}() override;\n" for i in range(9))
REPEATS = {
    "src/transient/Z1.cpp": (SPDX + "int f() {\n" + LINES + "}\n", None),
    "src/transient/Z2.cpp": (SPDX + "\n".join(f"    a += {i};\n// other" for i in range(LEAST)) +
                             "\n", "6 lines or more of code stand in src/transient/Z1.cpp:3, too"),
    "src/transient/Z3.cpp": (SPDX + "".join(f"  a += {i};\n" for i in range(LEAST - 1)), None),
    "substructures/mud/Z4.cpp": (SPDX + OVERRIDES, None),
    "substructures/mud/Z5.cpp": (SPDX + OVERRIDES, None),
}
PLACES = {
    "tools/M.py": (PYTHON, "is not executable"),
    "run2/summary.json": ("{}\n", "stay out of git"),
    "left over.mtx": ("1 1\n", "stay out of git"),
    "quickstart": ("#!/usr/bin/env bash\n# SPDX-License-Identifier: BSD-3-Clause\n", None),
}


def all_cases(longest):
    """Cases of all rules; `longest`: lines of a source file."""
    long = {
        "src/io/L.cpp": (SPDX + "\n" * longest, "more than"),
        "tools/L.py": (PYTHON + "\n" * longest, "more than"),
    }
    return {**INCLUDES, **WORDS, **SIZES, **REPEATS, **PLACES, **long}

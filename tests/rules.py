# SPDX-License-Identifier: Apache-2.0
"""rules.py SOURCE: every numbered rule of the normative pages is cited by a test, and every citation is of a rule.

A rule's number stands in bold where the page states it: **N-4.6-3** in numerics.md, **S-tile-2** in stream.md, **M-walk-1** in
microarchitecture.md. Numbers of a section count 1, 2, 3, ... A citation is the number, anywhere in a file of tests/; other folders may cite
as well."""
import collections
import pathlib
import re
import sys

FOLDERS = ["tests", "cmodel", "driver", "rtl", "testbench", "golden", "docs"]
PAGES = {"N": "numerics", "S": "stream", "M": "microarchitecture"}
NUMBER = r"\b([NSM])-((?:[a-z]+|\d+)(?:\.\d+)?)-(\d+)\b"


def main(source):
    defects = []
    defined, cited = set(), collections.Counter()
    for letter, page in PAGES.items():
        before = collections.Counter()
        for line, text in enumerate((source / "docs" / f"{page}.md").read_text().splitlines(), 1):
            for kind, section, number in re.findall(rf"\*\*{NUMBER}\*\*", text):
                before[section] += 1
                if kind != letter or int(number) != before[section]:
                    defects.append(f"docs/{page}.md:{line}: rule {kind}-{section}-{number}, expected {letter}-{section}-{before[section]}")
                defined.add(f"{kind}-{section}-{number}")
    for file in sorted(path for folder in FOLDERS for path in source.joinpath(folder).rglob("*")):
        if file.suffix not in {".cpp", ".hpp", ".sv", ".svh", ".sh", ".md"}:
            continue
        for line, text in enumerate(file.read_text().splitlines(), 1):
            for match in re.finditer(NUMBER, text):
                cited[match[0]] += file.is_relative_to(source / "tests")
                if match[0] not in defined:
                    defects.append(f"{file.relative_to(source)}:{line}: cites {match[0]}, a rule of no page")
    defects += [f"rule {rule}: no test cites it" for rule in sorted(rule for rule in defined if not cited[rule])]
    counts = ", ".join(f"{page}.md {sum(rule[0] == letter for rule in defined)}" for letter, page in PAGES.items())
    print(f"[figure] rules: {counts}; citations in tests = {cited.total()}; defects = {len(defects)} (limit 0)")
    for defect in defects:
        print(defect)
    return 1 if defects or not defined else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))

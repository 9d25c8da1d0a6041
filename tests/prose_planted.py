# SPDX-License-Identifier: Apache-2.0
"""prose_planted.py: prose.py finds each planted defect at its line, and nothing in text that is in order."""
import os
import sys
import tempfile

import prose

LONG = " ".join(["Word"] + ["word"] * 35)
PAGE = f"""# Title of `a` page
{LONG}.
- A name that is no name.
- There are none, and it was told; those that stay are not wrong.

| {" ".join(["cell"] * 26)} | `{" ".join(["code"] * 30)}` |
|---|---|
| [lost](gone.md) | [found](other.md#a-heading) |

[lost](other.md#nothing), [lost](#nothing) and [found](#title-of-a-page).

```console
$ ./run paint
$ FLAG=1 fastsplat draw --size 3 | fastsplat draw --colour \\
  red
$ fastsplat verb other
tools/absent --help
```

    fastsplat verb sub --wide

`./run fastsplat paint`, `./run test`, `tools/script --flag`, `tools/script --none` and `tools/script -n`.
""" + f"""
In order: it is no longer so. A "quote is no name". {LONG[:-5]}. `{LONG}` is code. {LONG[:-5]}.

```
{LONG} is no prose, [lost](gone.md).
```
<a id="d1"></a>One. <a id="d2"></a>Two. <a id="d1"></a>One again.
"""
HEADER = f"""// In order: is no longer.
// A value that is no
// number.
int x;  // told, but not at the line's beginning
/// {LONG[:90]}
/// {LONG[90:]}, docs/gone.md.
///
///     an example, told

// See docs/other.md, "A heading", and docs/other.md,
// "No heading".
"""
BODY = """// In order: there is no such beat, and it is no longer so.
int x;  // the end is none
const char* y = "a \\" // told";
//   A name that is
//   no name.
"""
EXPECTED = {
    ("page.md", 2, "sentences"), ("page.md", 3, "wordings"), ("page.md", 4, "wordings"), ("page.md", 6, "cells"),
    ("page.md", 8, "links"), ("page.md", 10, "links"), ("page.md", 12, "commands"), ("page.md", 20, "commands"), ("page.md", 22, "commands"),
    ("page.md", 29, "links"), ("a.hpp", 1, "wordings"), ("a.hpp", 5, "sentences"), ("a.hpp", 6, "links"), ("a.hpp", 10, "links"), ("b.cpp", 2, "bodies"), ("b.cpp", 4, "bodies"), ("c.sh", 1, "bodies"),
}
COUNTS = {"sentences": 2, "cells": 1, "wordings": 5, "links": 6, "commands": 8, "bodies": 3}
PROGRAM = """#!/bin/sh
case "$*" in
  help | "draw --help" | "verb --help" | "verb sub --help") printf '%s\\n' '  --size N' "$(test "$1" = verb && echo Subcommands:)" ;;
  *) exit 2 ;;
esac
"""
RUN = "#!/bin/sh\necho './run test'\n"
SCRIPT = "#!/bin/sh\necho --flag\n"

with tempfile.TemporaryDirectory() as root:
    for name, text in {"docs/page.md": PAGE, "docs/other.md": "## A heading\n", "base/a.hpp": HEADER, "base/b.cpp": BODY, "base/c.sh": "# it tells\n", "program": PROGRAM, "run": RUN, "tools/script": SCRIPT}.items():
        path = os.path.join(root, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(path, 0o755)
    found, folders, *_ = prose.count(root, os.path.join(root, "program"))

    ceiling = os.path.join(root, "prose.txt")
    with open(ceiling, "w", encoding="utf-8") as file:
        file.write("# kept\ndocs 9 0 9 9 9 9\n")
    prose.record(ceiling, found, folders, prose.ceilings(ceiling))
    lowered = prose.ceilings(ceiling)["docs"]

lines = [line for folder in found.values() for line in folder]
places = {(os.path.basename(line.split(":")[0]), int(line.split(":")[1]), line.split(": ")[1]) for line in lines}
counts = {kind: sum(len(found[folder, kind]) for folder in folders) for kind in prose.KINDS}
wrong = [f"not found: {place}" for place in sorted(EXPECTED - places)] + [f"in order, yet found: {place}" for place in sorted(places - EXPECTED)]
wrong += [f"{kind}: expected {COUNTS[kind]}, got {counts[kind]}" for kind in prose.KINDS if counts[kind] != COUNTS[kind]]
if lowered["sentences"] != 1 or lowered["cells"] != 0:
    wrong.append(f"--record: expected sentences lowered to 1 and cells kept at 0, got {lowered}")
print(f"[figure] planted defects found = {len(lines)} (limit {sum(COUNTS.values())}), wrong = {len(wrong)} (limit 0)")
print("\n".join(wrong + (lines if wrong else [])))
sys.exit(1 if wrong else 0)

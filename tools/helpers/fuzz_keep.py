# SPDX-License-Identifier: Apache-2.0
"""fuzz_keep.py KEPT RESULTS TARGETS TOOL: adds a run of tools/helpers/fuzz_targets to docs/evidence/fuzz.json.

RESULTS has one line per target, as printed by `one` in tools/helpers/fuzz_targets. Processor time and runs add up; edges are the maximum of all runs.
A finding resets its target to zero, because the code is about to change, and is kept until a run has none.
Interrupted targets keep their figures, targets that never ran have zeros, and those not in TARGETS (targets.def) are removed."""
import datetime
import json
import os
import re
import sys

kept, results, targets, tool = sys.argv[1:]
NOTHING = {"seconds": 0, "runs": 0, "edges": 0}
whole = {"targets": {}}
if os.path.exists(kept):
    with open(kept) as file:
        whole = json.load(file)
whole["tool"] = tool
whole["date"] = datetime.date.today().isoformat()
with open(results) as file:
    for line in file:
        name = line.split()[0]
        fine = re.fullmatch(r"\S+ +(\d+) runs, +(\d+) edges, +(\d+) s of processor, no finding\n", line)
        if line.endswith(" interrupted, not counted\n"):
            continue
        if not fine:
            whole["targets"][name] = dict(NOTHING, finding=line.split(None, 2)[2].strip())
            continue
        target = whole["targets"].setdefault(name, dict(NOTHING))
        target.pop("finding", None)
        target["seconds"] += int(fine[3])
        target["runs"] += int(fine[1])
        target["edges"] = max(target["edges"], int(fine[2]))
with open(targets) as file:
    names = re.findall(r"^FASTSPLAT_FUZZ_TARGET\(([a-z_]*),", file.read(), re.M)
whole["targets"] = {name: whole["targets"].get(name, dict(NOTHING)) for name in sorted(names)}
with open(kept + ".new", "w") as file:
    json.dump(whole, file, indent=1)
    file.write("\n")
os.replace(kept + ".new", kept)

"""fuzz_keep.py KEPT RESULTS TOOL: adds a run of packaging/fuzz to docs/evidence/fuzz.json.

RESULTS has a line a target, as `one` in packaging/fuzz writes it. Processor time and runs add up; edges are the most that a run saw. A target
with a finding starts again from nothing: what it ran before was of code that is about to change. One that was interrupted keeps what it has."""
import datetime
import json
import os
import re
import sys

kept, results, tool = sys.argv[1:]
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
            whole["targets"].pop(name, None)
            continue
        target = whole["targets"].setdefault(name, {"seconds": 0, "runs": 0, "edges": 0})
        target["seconds"] += int(fine[3])
        target["runs"] += int(fine[1])
        target["edges"] = max(target["edges"], int(fine[2]))
whole["targets"] = dict(sorted(whole["targets"].items()))
with open(kept + ".new", "w") as file:
    json.dump(whole, file, indent=1)
    file.write("\n")
os.replace(kept + ".new", kept)

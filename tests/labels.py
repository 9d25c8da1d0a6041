# SPDX-License-Identifier: Apache-2.0
"""labels.py CTEST BUILD LONGER: every test of the build has one of the labels `fast` and `slow`, and what LONGER (longer.cmake) names is a test.

`-L fast` takes a test that has both labels, none takes one that has neither, and a filter says nothing of a name that no test has."""
import collections
import json
import re
import subprocess
import sys

ctest, build, longer = sys.argv[1:]
tests = json.loads(subprocess.run([ctest, "--test-dir", build, "--show-only=json-v1"], check=True, stdout=subprocess.PIPE).stdout)["tests"]
with open(longer) as file:
    named = set(re.findall(r"^  ([^\s)]+)", file.read(), re.MULTILINE))
count = collections.Counter()
wrong = []
for test in tests:
    name = test["name"].split(" ")[0]  # GoogleTest's own word on a parameter follows
    labels = [label for entry in test.get("properties", []) if entry["name"] == "LABELS" for label in entry["value"]]
    speeds = [label for label in labels if label in ("fast", "slow")]
    count.update(speeds)
    if len(speeds) != 1:
        wrong.append(f"{test['name']}: labels fast and slow: expected one, got {' and '.join(speeds) or 'neither'}")
    if name in named:
        count.update(["named"])
        named.remove(name)
wrong += [f"{longer} names {name}, which no test is" for name in sorted(named)]
print(f"[figure] tests labelled fast = {count['fast']}, slow = {count['slow']}, longer ones named = {count['named']}, defects = {len(wrong)} (limit 0)")
print("\n".join(wrong))
sys.exit(0 if count["fast"] and count["slow"] and count["named"] and not wrong else 1)

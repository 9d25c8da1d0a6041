#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""declared_first.py FILE...: no module uses a signal above its declaration. Some tools refuse that; Icarus 11,
Verilator and Yosys do not."""
import re
import sys

# Signals of a module lie two columns in; deeper ones belong to a block and may share a name with another block's.
DECLARED = re.compile(r"^  logic\b(?: signed)?(?: *\[[^;=]*?\])* *(\w[^;=]*);", re.M)
names = early = 0
for path in sys.argv[1:]:
    text = re.sub(r"//[^\n]*|\"[^\"\n]*\"|`\w+\(\w+", "", open(path).read())  # a macro's first argument is a label
    body = text.find("\n);\n")  # behind the ports
    for found in DECLARED.finditer(text, body):
        for name in re.findall(r"(\w+)(?: *\[[^,]*\])* *(?:,|$)", found.group(1)):
            first = re.compile(r"(?<![\w.`$])" + name + r"\b").search(text, body)
            names += 1
            inner = re.search(r"^    +logic\b[^;=]*\b" + name + r"\b", text[body:found.start()], re.M)
            if first.start() < found.start() and not inner:
                early += 1
                line = text.count("\n", 0, first.start()) + 1
                print(f"{path}:{line}: uses {name} above its declaration")
print(f"[figure] signals declared = {names} (limit > 800), used above = {early} (limit 0)")
sys.exit(early > 0 or names <= 800)

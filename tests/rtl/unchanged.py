# SPDX-License-Identifier: Apache-2.0
"""unchanged.py NAME EMIT_PACKAGE SOURCE_DIR COMMAND...: runs COMMAND, unless passed.txt says that it passed on the same inputs.

Inputs: the RTL, the packages that C++ emits for configs/, the planted faults, the scripts, what READS names and the versions of the
tools. The same inputs give the same proof. Exit code 77: skipped. With FASTSPLAT_PROOFS=again it always runs, and what passes is
written to passed.txt."""
import fcntl
import glob
import hashlib
import os
import subprocess
import sys

name, emit, source = sys.argv[1:4]
command = sys.argv[4:]
kept = f"{source}/tests/rtl/passed.txt"

# What a test reads beside the RTL and tests/rtl.
RATCHET = ("docs/evidence/synthesis.json", "tools/pages/evidence/*.cpp")
READS = {"docs.timing": ("docs/microarchitecture.md", "docs/images/timing/*", "tools/pages/timing/*"),
         "rtl.placement_ratchet": RATCHET, "rtl.synthesis_ratchet": RATCHET}
TOOLS = ("yosys -V", "z3 --version", "verilator --version", "nextpnr-ice40 --version", "iverilog -V")


def files(*patterns):
    return sorted(path for pattern in patterns for path in glob.glob(f"{source}/{pattern}", recursive=True) if os.path.isfile(path))


def output(words):
    """The first line that a tool prints of itself; nothing without it."""
    try:
        return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False).stdout.split(b"\n")[0]
    except OSError:
        return b""


def inputs():
    digest = hashlib.sha256()
    for config in files("configs/*.toml", "configs/faults/*.toml", "tests/rtl/synthesis/*.toml"):
        digest.update(subprocess.run([emit, config], stdout=subprocess.PIPE, check=True).stdout)
    for path in files("rtl/**/*", "tests/rtl/**/*", "testbench/faults/*.def", *READS.get(name, ())):
        if path != kept:
            with open(path, "rb") as file:
                digest.update(path.removeprefix(source).encode() + b"\0" + file.read())
    for tool in TOOLS:
        digest.update(output(tool.split()) + b"\n")
    return digest.hexdigest()[:16]


def passed():
    """Hash by test."""
    with open(kept) as file:
        return dict(reversed(line.split()) for line in file if not line.startswith("#"))


def keep(key):
    with open(kept, "r+") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        head = "".join(line for line in file if line.startswith("#"))
        lines = passed() | {name: key}
        file.seek(0)
        file.truncate()
        file.write(head + "".join(f"{value} {test}\n" for test, value in sorted(lines.items())))


again = os.environ.get("FASTSPLAT_PROOFS") == "again"
before = inputs()
if not again and passed().get(name) == before:
    print(f"{name} passed on the same RTL, packages, scripts and tools ({before}); FASTSPLAT_PROOFS=again runs it again")
    sys.exit(77)
code = subprocess.run(command, check=False).returncode
if code == 0 and again and inputs() == before:
    keep(before)
sys.exit(code)

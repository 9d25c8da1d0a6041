# SPDX-License-Identifier: Apache-2.0
"""mutate.py ROOT BUILD [FLAGS]: what `tools/mutate` does; --help prints its flags.

Every mutant of rtl/ runs on the smallest device that has its module (devices.py) through the checks of check_mutants.cpp, cheapest
first. What lives goes on to the devices behind it, and to the proof of its module where there is one. A mutant that lives
through all of it is in exclusions.toml with the reason why nobody can see it, or the campaign is red."""
import argparse
import collections
import concurrent.futures
import json
import os
import random
import subprocess
import sys
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../tools/helpers"))
import campaign
import cpp_campaign
import devices
import evidence_stamp
import generate
import proofs
from exclusions import Exclusions

SAMPLE = 300
CPP = ("cmodel", "driver")
# Programs of tests over mutants, and the modules in them: what drives ports that no device of devices.py shows.
TESTS = {"fetch": generate.BESIDE, "top": ("top", "slice")}


def say(text: str):
    print(f"mutate: {text}", file=sys.stderr, flush=True)


class Parser(argparse.ArgumentParser):
    def error(self, message):
        campaign.usage(f"{message}; expected flags of tools/mutate --help")


def parse(words):
    parser = Parser(prog="tools/mutate", allow_abbrev=False, description="Runs mutants of rtl/ against the checks: each is killed, or "
                                     "tests/mutants/exclusions.toml explains why it cannot be. Exit code 1: an unexplained mutant lives, or an "
                                     "explained one was killed.")
    parser.add_argument("--module", action="append", metavar="M", help="all mutants of this module; repeatable")
    parser.add_argument("--all", action="store_true", help="all mutants; results of completed modules are kept in docs/evidence/mutants.json")
    parser.add_argument("--seed", type=int, default=1, metavar="S", help=f"which {SAMPLE}, without --all or --module (1)")
    parser.add_argument("--budget", type=float, metavar="MIN", help="start no mutant after this many minutes; mutants not run are listed")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="mutants at the same time, and proofs of them (2)")
    parser.add_argument("--one", type=int, metavar="N", help="only this mutant: describe it, and run every check on it")
    return parser.parse_args(words)


def chosen(arguments, mutants):
    if arguments.one is not None:
        found = [m for m in mutants if m["number"] == arguments.one]
        if not found:
            campaign.usage(f"--one {arguments.one}: not one of {len(mutants)} mutants; see the list of living mutants and build/mutants/corners/mutants.json")
        return found
    if arguments.module:
        known = sorted({m["module"] for m in mutants}) + ["cmodel and driver (without others)"]
        for module in arguments.module:
            if module not in known:
                campaign.usage(f"--module {module}: unknown module; expected one of {', '.join(known)}")
        return [m for m in mutants if m["module"] in arguments.module]
    if arguments.all:
        return mutants
    return sorted(random.Random(arguments.seed).sample(mutants, min(SAMPLE, len(mutants))), key=lambda m: m["number"])


def program(root, build, name, kind="check_mutants_"):
    say(f"building {kind}{name}")
    if subprocess.run([f"{root}/run", "build", f"{kind}{name}"], stdout=sys.stderr).returncode != 0:
        sys.exit(1)
    return f"{build}/bin/{kind}{name}"


def run_all(arguments, root, build, until):
    """{number: (where, what was said)} of the killed, those that live, those not tried."""
    mutants = chosen(arguments, generate.all_of(f"{root}/rtl"))
    program(root, build, "emit_package", "fastsplat_")
    kept = arguments.all or arguments.module  # not of a few, which are tried in seconds, nor of one, which is asked for to be seen
    module = {m["number"]: m["module"] for m in mutants}
    killed, untried = {}, []
    living = list(module)
    for device in devices.devices(root, build):
        tried = [number for number in living if module[number] in device.modules]
        if not tried:
            continue
        # The first device's whole program takes minutes to build: for single modules there is one of them alone.
        name = "modules" if device.name == devices.FIRST and arguments.module else device.name
        if name != devices.FIRST:
            campaign.write(f"{build}/mutants/living.txt", "".join(f"{number}\n" for number in tried))
        binary = program(root, build, name)
        journal = campaign.Journal(os.path.basename(binary), [binary, device.config], f"{build}/mutants/journal") if kept else None
        built = campaign.built(f"{build}/verilated/mutants_{name}/obj")
        absent = [number for number in tried if number not in built]
        tried = [number for number in tried if number in built]
        results = campaign.run(binary, device.config, tried, arguments.jobs, until, journal)
        untried += [number for number in tried if number not in results]
        for number, (verdict, said) in results.items():
            if verdict == "killed":
                killed[number] = (said if device.name == devices.FIRST else f"{device.name}/{said}")
        gone = {*killed, *untried}
        living = [number for number in living if number not in gone]
        say(f"{name}: {len(absent)} are not in it, {len(results)} tried, {len(tried) - len(gone.intersection(tried))} live")
        if not living:
            break
    for name, modules in TESTS.items():
        tried = [number for number in living if module[number] in modules]
        if not tried:
            continue
        binary = program(root, build, f"mutants_{name}", "")
        journal = campaign.Journal(os.path.basename(binary), [binary], f"{build}/mutants/journal") if kept else None
        results = cpp_campaign.run(binary, tried, arguments.jobs, until, journal)
        untried += [number for number in tried if number not in results]
        killed.update({number: f"tests/{name}/{said}" for number, (verdict, said) in results.items() if verdict == "killed"})
        gone = {*killed, *untried}
        living = [number for number in living if number not in gone]
        say(f"tests/{name}: {len(results)} tried, {len(tried) - len(gone.intersection(tried))} live")
    return mutants, killed, living, untried


def run_over_cpp(arguments, root, build, until):
    """The same of C++, whose mutants are a sample that is built."""
    mutants, killed, living, untried = [], {}, [], []
    for n, module in enumerate(arguments.module):
        binary = program(root, build, f"mutants_{module}", "")
        with open(f"{build}/mutants/{module}/mutants.json") as file:
            listed = json.load(file)
        if arguments.one is not None:
            listed = chosen(arguments, listed)
        results = cpp_campaign.run(binary, [m["number"] for m in listed], arguments.jobs, until)
        say(f"{module}: {len(results)} tried")
        for mutant in listed:
            number = mutant["number"]
            mutant["number"] += n * 1000000  # numbers of two folders of C++ are not each other's
            if number not in results:
                untried.append(mutant["number"])
            elif results[number][0] == "killed":
                killed[mutant["number"]] = results[number][1]
            else:
                living.append(mutant["number"])
        mutants += listed
    return mutants, killed, living, untried


def hand_to_proofs(root, build, mutants, living, exclusions, jobs):
    """What the proofs say of those that nobody has explained, as many at the same time as mutants."""
    journal, lock = campaign.Journal("proofs", proofs.sources(root, build), f"{build}/mutants/journal"), threading.Lock()

    def refuted(mutant):
        number = mutant["number"]
        if number not in journal.said:
            say(f"{number} goes to the proof of {mutant['module']}")
            text = proofs.refutes(root, build, mutant)
            with lock:
                journal.said[number] = ("killed", text) if text else ("lives", "")
                journal.add(number, journal.said[number])
        return journal.said[number][1]

    handed = [m for m in mutants if m["number"] in living and not exclusions.of(m) and proofs.has(m["module"])]
    with concurrent.futures.ThreadPoolExecutor(max(1, jobs)) as pool:
        said = pool.map(refuted, handed)
        return {mutant["number"]: f"proof: {text}" for mutant, text in zip(handed, said) if text}


def told(mutant):
    return f"{mutant['number']} {mutant.get('file', mutant['module'])}:{mutant['line']} {campaign.name_of(mutant)}\n      {mutant['source']}"


def table(mutants, killed, living, exclusions):
    rows = {}
    for mutant in mutants:
        row = rows.setdefault(mutant["module"], {"mutants": 0, "killed": collections.Counter(), "excluded": collections.Counter(), "living": 0})
        row["mutants"] += 1
        number = mutant["number"]
        if number in killed:
            row["killed"][killed[number].split(":")[0]] += 1
        elif number in living:
            excluded = exclusions.of(mutant)
            if excluded:
                row["excluded"][excluded["class"]] += 1
            else:
                row["living"] += 1
    return rows


def print_table(rows):
    print(f"{'module':15} {'mutants':>7} {'killed':>7} {'excluded':>8} {'living':>6}  killed by")
    total = collections.Counter()
    for module, row in rows.items():
        killed, excluded = sum(row["killed"].values()), sum(row["excluded"].values())
        by = ", ".join(f"{name} {count}" for name, count in row["killed"].most_common())
        print(f"{module:15} {row['mutants']:7} {killed:7} {excluded:8} {row['living']:6}  {by}")
        total.update(mutants=row["mutants"], killed=killed, excluded=excluded, living=row["living"])
    could = total["killed"] + total["living"]
    print(f"[figure] mutants = {total['mutants']}, killed = {total['killed']}, excluded with a reason = {total['excluded']}, "
          f"living = {total['living']} (limit 0): {100 * total['killed'] / max(could, 1):.2f} % of those that can be seen")


def judged(mutants, killed, living, exclusions) -> bool:
    """Says what is red: a mutant that lives unexplained, one that is explained and was killed, nothing killed at all."""
    red = not killed
    for mutant in mutants:
        explained = exclusions.of(mutant)
        if mutant["number"] in living and not explained:
            print("LIVES: " + told(mutant))
            red = True
        if mutant["number"] in killed and explained:
            print(f"EXCLUDED BUT KILLED by {killed[mutant['number']]}: " + told(mutant))
            red = True
    if not killed:
        print("nothing was killed")
    return red


def tool(root, build, cpp: bool) -> str:
    if not cpp:
        return " ".join(subprocess.run(["verilator", "--version"], capture_output=True, text=True).stdout.split()[:2])
    with open(f"{build}/CMakeCache.txt") as file:
        compiler = next(line.strip().split("=", 1)[1] for line in file if line.startswith("CMAKE_CXX_COMPILER:"))
    return subprocess.run([compiler, "--version"], capture_output=True, text=True).stdout.split("\n")[0]


def keep(root, build, cpp, rows, mutants, living, exclusions):
    """The rows that were tried to the end. Those of C++, a sample, have a part of their own."""
    path = f"{root}/docs/evidence/mutants.json"
    whole = {"modules": {}}
    if os.path.exists(path):
        with open(path) as file:
            whole = json.load(file)
    kept = whole.setdefault("cplusplus", {"modules": {}}) if cpp else whole
    kept["tool"] = tool(root, build, cpp)
    now = evidence_stamp.stamp(root)
    for module, row in rows.items():
        row["date"] = now["date"]
        if not cpp:
            row["rtl"] = now["rtl"][module.removeprefix("fastsplat_")]
    kept["modules"].update(rows)
    kept["modules"] = dict(sorted(kept["modules"].items()))
    gone = set(rows)
    survivors = [s for s in kept.get("survivors", []) if s["module"] not in gone]
    for mutant in mutants:
        if mutant["module"] in rows and mutant["number"] in living and not exclusions.of(mutant):
            survivors.append({key: mutant[key] for key in ("module", "line", "source", "what", "original")})
    kept["survivors"] = survivors
    campaign.write(path, json.dumps(whole, indent=1) + "\n")
    say(f"{path}; `tools/evidence page` makes docs/evidence.md of it")


def main(words) -> int:
    root, build, *rest = words
    arguments = parse(rest)
    cpp = bool(arguments.module) and set(arguments.module) <= set(CPP)
    exclusions = Exclusions(f"{root}/tests/mutants/{'exclusions_cpp' if cpp else 'exclusions'}.toml")
    until = time.monotonic() + 60 * arguments.budget if arguments.budget else None
    mutants, killed, living, untried = (run_over_cpp if cpp else run_all)(arguments, root, build, until)
    proved = hand_to_proofs(root, build, mutants, living, exclusions, arguments.jobs)
    killed.update(proved)
    living = [number for number in living if number not in proved]
    if arguments.one is not None:
        print(told(mutants[0]))
        print("killed by " + killed[arguments.one] if arguments.one in killed else "lives")
        return 0
    rows = table(mutants, killed, set(living), exclusions)
    print_table(rows)
    red = judged(mutants, killed, set(living), exclusions)
    for entry in exclusions.unused(mutants) if arguments.all or (cpp and set(arguments.module) == set(CPP)) else []:
        print(f"EXCLUDES NOTHING: {entry['module']}: {entry['line']}")
        red = True
    if untried:
        print(f"not run: {len(untried)} (the budget is exhausted)")
    campaign.write(f"{build}/mutants/killed.json", json.dumps({str(n): k for n, k in sorted(killed.items())}, indent=0))
    if arguments.all or arguments.module:
        short = {m["module"] for m in mutants if m["number"] in set(untried)}
        keep(root, build, cpp, {module: row for module, row in rows.items() if module not in short}, mutants, set(living), exclusions)
    return 1 if red else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

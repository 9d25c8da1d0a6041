# SPDX-License-Identifier: Apache-2.0
"""sample.py SOURCE BUILD: the machinery of tools/mutate, in seconds. Fixed mutants of the registers are killed, each by the check that is
there for it; one that changes nothing lives and is red; the generator finds its mutants, and each exclusion one of them."""
import json
import sys
import tempfile

import campaign
import cpp_campaign
import generate
import generate_cpp
import mutate
from exclusions import Exclusions

FEWEST, FEWEST_CPP = 1400, 4000
# (line, name, check): what once lived, and a few that anything sees.
FIXED = [
    ("rvalid_o <= 1'b1;", "1'b1 becomes 0 of 1'b1", "random"),
    ("rresp_o <= OKAY;", "dropped", "random"),
    ("rdata_o <= '0;", "dropped", "registers"),
    ("if (chosen_q == '0) begin", "always of chosen_q == '0", "random"),
    ("assign write = awvalid_i && wvalid_i && !bvalid_o;", "&& becomes || of awvalid_i && wvalid_i", "registers"),
    ("else counter_q[n] <= counter_q[n] + CB'(increments_i[16*n+:16]);", "dropped", "random"),
    ("ready_o <= moves || !(spare_q || taken);", "without its right side of moves || !(spare_q || taken)", "hazards"),
    ("tiles_q <= tiles + 2'(pixels_valid && pixels_ready && last);", "dropped", "random"),
    ("fastsplat_pkg::REG_ERROR: rdata_o <= {16'd0, error_opcode_i, error_rule_i};", "dropped", "refusals"),
]
# (program, line, name, test): of what lies around the core.
OVER_TESTS = [
    ("top", "assign write_address = (s_axil_wstrb == 4'hf) ? s_axil_awaddr : NOWHERE;", "always its first of (s_axil_wstrb == 4'hf) ? s_axil_awaddr : NOWHERE", "Top"),
    ("top", ".slices_busy_i(core_valid || m_axis_tvalid),", "without its right side of core_valid || m_axis_tvalid", "Top"),
    ("fetch", "unsent_q <= unsent_q + DB'(arrives) - DB'(sends);", "dropped", "Fetch"),
    ("fetch", "assign judges = verdict_valid && judged_valid && judged_counted;", "without its right side of verdict_valid && judged_valid && judged_counted", "Fetch"),
]

source, build = sys.argv[1:]
failures = []
found, _ = generate.mutate(f"{source}/rtl")
mutants = generate.all_of(f"{source}/rtl")
print(f"[figure] mutants of rtl = {len(mutants)} (limit >= {FEWEST})")
if len(mutants) < FEWEST or len({m["number"] for m in mutants}) != len(mutants):
    failures.append("too few mutants, or a number twice")
for name, _, listed in found:
    if [m.number for m in listed] != list(range(generate.first_of(name), generate.first_of(name) + len(listed))):
        failures.append(f"{name}: numbers left out")
exclusions = Exclusions(f"{source}/tests/mutants/exclusions.toml")
for entry in exclusions.unused(mutants):
    failures.append(f"excludes nothing: {entry['module']}: {entry['line']}: {entry['mutants']}")
print(f"[figure] entries of exclusions.toml = {len(exclusions.entries)}, each with a mutant")

# Of C++ only that they are found and explained: they run in the campaign.
in_cpp = [vars(m) for module in mutate.CPP for _, _, listed in generate_cpp.mutate(source, module)[0] for m in listed]
print(f"[figure] mutants of cmodel and driver = {len(in_cpp)} (limit >= {FEWEST_CPP})")
if len(in_cpp) < FEWEST_CPP:
    failures.append("too few mutants of C++")
of_cpp = Exclusions(f"{source}/tests/mutants/exclusions_cpp.toml")
for entry in of_cpp.unused(in_cpp):
    failures.append(f"excludes nothing: {entry['module']}: {entry['line']}: {entry['mutants']}")
print(f"[figure] entries of exclusions_cpp.toml = {len(of_cpp.entries)}, each with a mutant")

with open(f"{build}/mutants/sample/mutants.json") as file:
    sample = json.load(file)
planted = next(m for m in sample if m["source"] == "planted")
chosen = {}
for line, name, check in FIXED:
    of = [m for m in sample if m["source"] == line and campaign.name_of(m) == name]
    if not of:
        failures.append(f"mutant not found: '{name}' of: {line}")
    else:
        chosen[of[0]["number"]] = (line, name, check)
results = campaign.run(f"{build}/bin/check_mutants_sample", f"{source}/tests/mutants/corners.toml", [*chosen, planted["number"]], 1)
for number, (line, name, check) in chosen.items():
    verdict, said = results[number]
    print(f"[figure] {name}: {verdict} {said}")
    if verdict != "killed" or not said.startswith(check + ":"):
        failures.append(f"{name} of '{line}': expected killed by {check}, got {verdict} {said}")
verdict, said = results[planted["number"]]
print(f"[figure] a mutant that changes nothing: {verdict} {said}")
if verdict != "lives":
    failures.append("the mutant that changes nothing is killed")

for program in dict.fromkeys(program for program, *_ in OVER_TESTS):
    with open(f"{build}/mutants/{program}/mutants.json") as file:
        listed = json.load(file)
    wanted = {}
    for line, name, test in [entry for of, *entry in OVER_TESTS if of == program]:
        of = [m["number"] for m in listed if m["source"] == line and campaign.name_of(m) == name]
        if not of:
            failures.append(f"mutant not found: '{name}' of: {line}")
        wanted.update({number: (line, name, test) for number in of[:1]})
    for number, (verdict, said) in cpp_campaign.run(f"{build}/bin/mutants_{program}", list(wanted), 1).items():
        line, name, test = wanted[number]
        print(f"[figure] {program}: {name}: {verdict} {said}")
        if verdict != "killed" or not said.startswith(test):
            failures.append(f"{name} of '{line}': expected killed by tests/{program}, got {verdict} {said}")

# A campaign that was stopped in the middle of a line goes on behind the last whole one.
with tempfile.TemporaryDirectory() as folder:
    told_before = next(iter(chosen))
    program = [f"{build}/bin/check_mutants_sample", f"{source}/tests/mutants/corners.toml"]
    journal = campaign.Journal("sample", program, folder)
    journal.add(told_before, ("killed", "before: the campaign was stopped"))
    journal.file.write(f"{planted['number']} kil")
    journal.file.close()
    again = campaign.run(*program, [told_before, planted["number"]], 1, None, campaign.Journal("sample", program, folder))
    kept = campaign.Journal("sample", program, folder).said
print(f"[figure] of a journal of one whole line and half of one: {again[told_before][1]}; the other {again[planted['number']][0]}; kept {len(kept)}")
if again[told_before][1] != "before: the campaign was stopped" or again[planted["number"]][0] != "lives" or kept != again:
    failures.append(f"a campaign that was stopped does not go on: {again}, kept {kept}")

# Mutants without code in the program are not run, so mutants with code must not be taken for them.
built = campaign.built(f"{build}/verilated/mutants_sample/obj")
missing = [number for number in chosen if number not in built]
print(f"[figure] of {len(chosen)} mutants that are killed the program has {len(chosen) - len(missing)} (limit {len(chosen)}); constants in its sources {len(built)}")
if missing:
    failures.append(f"taken for absent, but killed: {missing}")

killed = {number: said for number, (verdict, said) in results.items() if verdict == "killed"}
print("the verdict on it:")
if not mutate.judged([planted, *[m for m in sample if m["number"] in chosen]], killed, {planted["number"]}, exclusions):
    failures.append("a mutant lives unexplained, and the campaign is not red")
if mutate.judged([m for m in sample if m["number"] in chosen], killed, set(), exclusions):
    failures.append("all are killed, and the campaign is red")
for failure in failures:
    print("FAILED: " + failure)
sys.exit(1 if failures else 0)

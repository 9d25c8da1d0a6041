# SPDX-License-Identifier: Apache-2.0
"""Streams for bench.sv, its simulation, and the signals of that simulation by cycle."""
import bisect
import glob
import os
import re
import shutil
import subprocess

OPCODES = {"BF": 0x46, "LT": 0x4C, "BT": 0x54, "BS": 0x53, "S": 0x50, "E": 0x45, "C": 0x43, "ES": 0x73, "ET": 0x74}
NAMES = {code: name for name, code in OPCODES.items()}


def beat(name, *words, more=0):
    """A record of docs/stream.md: w1, w2, ... and the bits of w0 above the opcode."""
    return sum((word & 0xFFFFFFFF) << 32 * i for i, word in enumerate((OPCODES[name] | more << 8, *words)))


def label(word):
    """A beat as pictures name it, with the tag of a splat, an ellipse and a cull_block."""
    name = NAMES.get(word & 255, "?")
    return name + str(word >> 32 & 0xFFFF) if len(name) == 1 else name


def splat(tag, x, y, radius_set=0):
    """Its first window begins at pixel (x, y). Set 0 has one window, set 1 two by two."""
    return beat("S", tag, (x + radius_set) * 8, (y + radius_set) * 8, 0, 255 << 16, more=radius_set)


def tile(mode, width, height, *sheets, number=0):
    """begin_tile to end_tile, of sheets of splats, which are given by their places."""
    beats, tag = [beat("BT", number, 0, 0, width | height << 16, more=mode)], 0
    for sheet, places in enumerate(sheets):
        splats = [splat(tag + i, *place) for i, place in enumerate(places)]
        beats += [beat("BS", sheet), *splats, beat("ES", sheet, len(splats))]
        tag += len(splats)
    return beats + [beat("ET", number, len(sheets))]


def preamble(package):
    """begin_frame and all tables that the device has. Two splats at one place are opaque."""
    beats = [beat("BF", 0x31535346, package["HASH_LOW"], package["HASH_HIGH"], 32 | 32 << 16, 2, more=2 << 8)]
    classified = [(3, 4 * 2 ** package["CLASSIFY_LOG2"] + 4), (4, 97), (5, 129), (6, 13), (7, 4)] if package["DENSITIES"] else []
    opaque = {1: package["RADIAL_WORD_MOST"], 2: package["FACTOR_WORD_MOST"]}
    for table, count, *radius_set in [(0, 16, 0, 8, 0), (0, 32, 1, 16, 2), (1, package["RADIAL_WORDS"]), (2, package["SEGMENTS"] + 1), *classified]:
        number, rho, base = radius_set or (0, 0, 0)
        beats.append(beat("LT", number, rho, count, base, more=table))
        beats += [sum(opaque.get(table, 1) << 32 * i for i in range(min(8, count - at))) for at in range(0, count, 8)]
    return beats


def simulate(root, emit, folder, section, key, parts):
    """Signals of `tiny` with two radius sets and `key`. `parts` of its stream: beats, whose last are sets where the device culls, and their splats."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    with open(f"{root}/configs/tiny.toml") as file:
        text = file.read().replace("sets = 1", "sets = 2") + ("" if section == "composite" else f"\n[{section}]\n")
    with open(f"{folder}/config.toml", "w") as file:
        file.write(text.replace(f"[{section}]\n", f"[{section}]\n{key}\n"))
    with open(f"{folder}/fastsplat_pkg.sv", "w+") as file:
        subprocess.run([emit, f"{folder}/config.toml"], check=True, stdout=file)
        file.seek(0)
        constants = re.findall(r"(\w+) = (?:\d+'h([0-9a-f]+)|(\d+));", file.read())
    stream, commands = preamble({name: int(bits, 16) if bits else int(number) for name, bits, number in constants}), []
    for words, splats in parts:
        start = len(stream) if commands else 0
        stream += words
        sets = sum(NAMES.get(word & 255) == "C" for word in words)
        commands.append(32 * start | len(stream) - start << 64 | sets << 96 | len(splats) << 128)
        stream += splats
    for name, words in (("beats", stream), ("commands", commands)):
        with open(f"{folder}/{name}.hex", "w") as file:
            file.writelines(f"{word:x}\n" for word in words)
    build = ["verilator", "--binary", "--timing", "--trace", "--assert", "-Wno-lint", "-Wno-fatal", "-j", "2", "--x-initial", "0", "--x-assign", "0",
             "-MAKEFLAGS", "OPT_FAST=-O0", "-MAKEFLAGS", "OPT_GLOBAL=-O0", f"-I{root}/rtl", "--Mdir", f"{folder}/obj", "--top-module", "bench",
             f"{folder}/fastsplat_pkg.sv", *sorted(glob.glob(f"{root}/rtl/**/*.sv", recursive=True)), f"{os.path.dirname(os.path.abspath(__file__))}/bench.sv"]
    for command in (build, [f"{folder}/obj/Vbench"]):
        with open(f"{folder}/log", "w") as log:
            if subprocess.run(command, cwd=folder, stdout=log, stderr=subprocess.STDOUT).returncode != 0:
                raise SystemExit(f"timing: error: {os.path.basename(command[0])} failed; see {folder}/log")
    return Signals(f"{folder}/wave.vcd")


class Signals:
    """Of a VCD: the values of a signal by cycle, each taken at the falling edge of bench.clk_i."""

    def __init__(self, path):
        self.codes, self.changes, scope, time = {}, {}, [], 0
        with open(path) as file:
            for line in file:
                word = line.split() or [""]
                if word[0] == "$scope":
                    scope.append(word[2])
                elif word[0] == "$upscope":
                    scope.pop()
                elif word[0] == "$var":
                    self.codes[".".join(["", *scope, word[4]]).replace(".[", "[")] = word[3]
                elif line[0] == "#":
                    time = int(line[1:])
                elif line[0] in "01b":
                    value, code = (word[0][1:], word[1]) if line[0] == "b" else (line[0], word[0][1:])
                    self.changes.setdefault(code, []).append((time, int(value, 2)))
        self.falls = [time for time, value in self.changes[self.code("bench.clk_i")] if time and not value]

    def code(self, end):
        found = {code for name, code in self.codes.items() if name.endswith("." + end)}
        if len(found) != 1:
            raise SystemExit(f"timing: error: expected one signal {end} in the RTL, found {len(found)}")
        return found.pop()

    def __call__(self, end, bit=None):
        """`end`: of the signal's path; ports of the device go by their name alone. With `bit`, that bit of it."""
        changes = self.changes.get(self.code(end if "." in end else f"u_core.{end}"), [(0, 0)])
        values = [changes[max(bisect.bisect_right(changes, (fall, 1 << 300)) - 1, 0)][1] for fall in self.falls]
        return values if bit is None else [value >> bit & 1 for value in values]

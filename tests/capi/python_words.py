# SPDX-License-Identifier: Apache-2.0
"""python_words.py STREAM VECTORS: testbench/capi/python gives the same words of a stream as the program."""
import json
import sys

import numpy as np

import fastsplat

stream, vectors = sys.argv[1:]
model = fastsplat.Model(fastsplat.Config("tiny"))
beats = fastsplat.read_stream(stream)
records, pictures = [], []
for part in np.array_split(beats, 7):
    model.feed(part)
    records += model.taps()
    pictures += model.tiles()
model.finish()

written = {kind: [] for kind in fastsplat.TAPS}
for kind in fastsplat.TAPS:
    with open(f"{vectors}/{kind}.hex") as lines:
        written[kind] = [[int(word, 16) for word in line.split()] for line in lines]
got = {kind: [] for kind in fastsplat.TAPS}
for tap in records:
    assert tap.words.dtype == np.uint32
    got[tap.kind].append([tap.tile, tap.sheet, tap.tag, tap.x % 2**32, tap.y % 2**32] + tap.words.tolist())
assert got == written, "taps differ"

with open(f"{vectors}/vectors.json") as file:
    contents = json.load(file)
assert model.counters == contents["counters"], "counters differ"
assert f"{fastsplat.Config('tiny').hash:016x}" == contents["config"]["hash"]

pixels = iter(written["pixel"])
for tile in pictures:
    expected = np.array([next(pixels)[5:] for _ in range(tile.rgba.shape[0] * tile.rgba.shape[1])], dtype=np.uint32)
    assert np.array_equal(tile.rgba.reshape(-1, 4), expected), "a tile's pixels differ"
assert next(pixels, None) is None and pictures

# Errors raise Error with the library's message; differences give a verdict.
for wrong, status in ((lambda: fastsplat.Config("tinny"), fastsplat.INPUT),
                      (lambda: model.feed(beats), fastsplat.USAGE),
                      (lambda: fastsplat.Config("tiny")["array.lines"], fastsplat.USAGE)):
    try:
        wrong()
    except fastsplat.Error as error:
        assert error.status == status, error
    else:
        raise AssertionError("not refused")
# Invalid numbers, names and files are refused here, before a cast changes them.
damaged = stream + ".damaged"
with open(stream, "rb") as whole, open(damaged, "wb") as file:
    file.write(whole.read() + b"xyz")
checker, fresh = fastsplat.Checker(fastsplat.Config("tiny")), fastsplat.Model(fastsplat.Config("tiny"))
for wrong, kind, words in ((lambda: fastsplat.read_stream(damaged), ValueError, "not a multiple of the beat size, 32"),
                           (lambda: fresh.feed(beats.astype(float)), ValueError, "whole numbers"),
                           (lambda: fresh.feed(beats.astype(np.int64) + 2**32), ValueError, "0 to 4294967295"),
                           (lambda: fresh.feed(beats.astype(np.int64) - 2**32), ValueError, "0 to 4294967295"),
                           (lambda: checker.showed("snap", 0, keeps=3), TypeError, "unknown field keeps"),
                           (lambda: checker.showed("snap", 0, words_count=3), TypeError, "unknown field words_count"),
                           (lambda: checker.showed("snap", 0, tag=2**33), ValueError, "0 to 4294967295"),
                           (lambda: checker.showed("snap", -1, tag=1), ValueError, "cycle: expected 0 to 18446744073709551615"),
                           (lambda: checker.showed("snap", 0, tag=1.5), ValueError, "tag: expected 0 to 4294967295, got 1.5"),
                           (lambda: checker.showed("snip", 0), ValueError, "unknown port 'snip'; expected one of snap, "),
                           (lambda: checker.start(-1), ValueError, "first_beat: expected 0 to 18446744073709551615, got -1"),
                           (lambda: fastsplat.Checker(fastsplat.Config("tiny"), seed=2**64), ValueError, "seed: expected 0 to "),
                           (lambda: fastsplat.Checker(fastsplat.Config("tiny"), stop_after=-1), ValueError, "stop_after: expected 0 to "),
                           (lambda: fastsplat.Checker(fastsplat.Config("tiny"), input_pattern="always\0x"), ValueError, "contains a NUL"),
                           (lambda: fastsplat.Model(fastsplat.Config("tiny"), taps=["snop"]), ValueError, "unknown tap 'snop'; expected one of snap, "),
                           (lambda: fastsplat.Config("tiny\0junk"), ValueError, "contains a NUL"),
                           (lambda: fastsplat.Config("tiny")["array.lanes\0x"], ValueError, "contains a NUL"),
                           (lambda: checker.finish([0.5] * 16), ValueError, "whole numbers")):
    try:
        wrong()
    except kind as error:
        assert words in str(error), error
    else:
        raise AssertionError(f"not refused: {words}")
fresh.feed(beats.astype(np.int64).tolist())
fresh.finish()
assert fresh.counters == model.counters, "whole numbers of another type are the same beats"
checker = fastsplat.Checker(fastsplat.Config("tiny"))
checker.took(beats)
assert not checker.finish() and checker.report().verdict == "mismatch" and checker.first_mismatch()
# Each field reaches its place.
tiny = fastsplat.Config("tiny")
for port, fields, detector in (("verdict", {"tag": 7, "hidden": 1}, "verdicts"), ("pixels", {"keep": 1, "tile": 3, "cut": 1}, "tiles")):
    checker = fastsplat.Checker(tiny, verdicts=True)
    checker.start(0)
    checker.showed(port, 1, np.zeros(4 * tiny["array.lanes"] if port == "pixels" else 0, dtype=int), **fields)
    assert checker.report().detector == detector, checker.report()
    print(f"[figure] python_{port} = {checker.first_mismatch()} (limit one line)")
checker = fastsplat.Checker(tiny)
checker.took(beats)
checker.showed("pixels", 1, np.zeros(4 * tiny["array.lanes"], dtype=int), keep=2, tile=3)
checker.finish()
assert "RTL has stage pixel, tile 3, pixel (1,0)" in checker.first_mismatch(), checker.first_mismatch()
print(f"[figure] python_records = {len(records)} (limit > 1000)")
print(f"[figure] python_tiles = {len(pictures)} (limit > 1)")
assert len(records) > 1000 and len(pictures) > 1

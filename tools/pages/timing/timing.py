# SPDX-License-Identifier: Apache-2.0
"""timing.py ROOT EMIT_PACKAGE FOLDER [--check]: what `tools/timing` does. Draws docs/images/timing/*.svg; --check compares with them."""
import os
import pathlib
import sys

from drawing import draw
from waves import beat, label, simulate, tile

COMPOSITED = ["tap_composite_valid_o", "tap_sheet_done_o"]
TOKEN = "S0: windows of the splat with tag 0. ES: end_sheet, and its token."


def when(valid, texts):
    return [text if there else None for there, text in zip(valid, texts)]


def beats(s, valid, data, bit=None):
    return when(s(valid, bit), map(label, s(data)))


def nth(valid, texts):
    """Each pulse has the next of the texts: what comes by a stage that keeps the order and loses nothing."""
    rest = iter(texts)
    return [next(rest, None) if there else None for there in valid]


def both(one, other):
    return [a & b for a, b in zip(one, other)]


def cycles(values):
    return [i for i, value in enumerate(values) if value]


def decode(s):
    return "decode", beats(s, "u_decode.beat_valid_q", "u_decode.beat_q")


def done(s, name):
    """The cycles in which decode carries out records of that name."""
    return cycles(there and label(word) == name for there, word in zip(s("u_decode.accepted"), s("u_decode.beat_q")))


def windows(s):
    """c0 to W: tags of windows, and the token of end_sheet."""
    def stage(valid, last, tags):
        return ["ES" if token else f"S{tag}" if there else None for there, token, tag in zip(valid, last, tags)]
    yield "c0", stage(s("u_splat.valid"), s("u_splat.last"), s("u_splat.tag"))
    for n, name in enumerate(["c1", "c2", "c3", "c4", "c5", "c6 = A", "B", "C", "W"]):
        yield name, stage(s("u_splat.valid_q", n), s("u_splat.last_q", n), s(f"u_splat.tag_q[{n + 1}]"))


def pipe(s, texts):
    """k1 to k6; texts(n): of stage n, by cycle; or the texts of all that comes, in order."""
    for n in range(1, 7):
        valid = s("u_compositor.valid_q", n - 1)
        yield f"k{n}", when(valid, texts(n)) if callable(texts) else nth(valid, texts)


def check(s):
    offered = beats(s, "s_tvalid_i", "s_tdata_i")
    return ("Check and decode: beats pass two registers of check; a splat with a wrong tag is refused, and the device ends the tile",
            "t", [i for i in cycles(s("s_tready_o")) if offered[i] == "BT"][1], [(-1, 17)],
            ["s_tvalid_i", "s_tready_o", ("s_tdata_i", offered), ("first register", beats(s, "u_check.next_valid_q", "u_check.next_q")),
             ("second register", beats(s, "u_check.beat_valid_q", "u_check.beat_q")), ("check's output", beats(s, "u_check.valid_o", "u_check.data_o")),
             decode(s), ("window issued", "u_decode.issues"), "error_o"],
            ["t: begin_tile (BT) is taken. BS: begin_sheet. S0, S1: splats of four windows.",
             "S9: a splat with the wrong tag. ES, ET: end_sheet and end_tile, behind S9 the device's own."])


def splat_path(s):
    bank = "gen_row[0].gen_bank[0].u_bank."
    return ("Splat path: four windows in a row, and the token of end_sheet, pass c0 to W; sums are forwarded between windows at one place",
            "w", cycles(s("u_decode.issues"))[0], [(-1, 15)],
            [decode(s), ("window issued", "u_decode.issues"), *windows(s), ("W's sum to C", bank + "forward_c_q"),
             ("W's sum to B", both(s(bank + "hit_w"), s(bank + "valid_b_q"))), "tap_snap_valid_o", "tap_window_valid_o", "tap_sheet_valid_o"],
            ["w: decode issues the first window. " + TOKEN, "S0, S1 and S3 lie at one place, S2 beside it."])


def compositor(s):
    def slice_of(block, part):
        return [f"{number}.{half}" for number, half in zip(s(block), s(part))]
    row_1 = [str(row.bit_length() - 1) for row in s("u_dirty.f1_row_q")]
    return ("Compositor, R = 2: the token of end_sheet starts the walk; two dirty blocks of two slices pass k0 to k6",
            "e", done(s, "ES")[0], [(-1, 24)],
            [decode(s), ("c4 and W", ["ES" if a or b else None for a, b in zip(s("u_splat.last_q", 3), s("u_splat.last_q", 8))]),
             ("f1", when(s("u_dirty.f1_valid_q"), row_1)), ("f2", when(s("u_dirty.f2_valid_q"), map(str, s("u_dirty.f2_number_q")))),
             ("f3", when(s("u_dirty.f3_row_q"), map(str, s("u_dirty.f3_number_q")))),
             ("k0", when(s("u_dirty.valid_o"), slice_of("u_dirty.block_o", "u_dirty.slice_o"))), ("sheet words read", "u_compositor.sheet_re_o"),
             *pipe(s, lambda n: slice_of(f"u_compositor.addr_q[{n}]", f"u_compositor.slice_q[{n}]")), *COMPOSITED, ("at rest", "u_compositor.idle_o")],
            ["e: end_sheet (ES) is carried out; its token passes c4 and W. 1.0, 1.1: the slices of block 1.",
             "f1 to f3: the row of blocks, 0. ET: end_tile, which waits for rest."])


def pixel_out(s):
    def number(x, y):
        return [str(3 * row + column // 2) for column, row in zip(s(f"u_pixel_out.{x}"), s(f"u_pixel_out.{y}"))]
    valid, sent = s("m_tvalid_o"), [0]
    for taken in both(valid, s("m_tready_i")):
        sent.append(sent[-1] + taken)
    return ("Pixel out: the six beats of a tile of 5 x 2 pixels pass r0 to r2 and wait for the sink", "E", done(s, "ET")[0], [(-1, 13)],
            [decode(s), ("r0", when(s("picture_re"), number("x_q", "y_q"))), ("r1", when(s("u_pixel_out.valid_r1_q"), number("x_r1_q", "row_r1_q"))),
             ("r2 = m_tdata_o", when(valid, map(str, sent))), "m_tvalid_o", "m_tready_i",
             ("m_tkeep_o", when(valid, [f"{keep:02b}" for keep in s("m_tkeep_o")])), ("m_tlast_o", both(valid, s("m_tlast_o"))),
             ("at rest", "u_pixel_out.idle_o")],
            ["E: end_tile (ET) is carried out. 0 to 5: the beats, three to a row.",
             "r0 is shown where the picture is read. All stages stand still while a beat waits."])


def registers(s):
    return ("Registers: two reads, the second of an unknown address, and a write whose data come late", "c", cycles(s("arvalid_i"))[0], [(-1, 8)],
            ["arvalid_i", "arready_o", ("araddr_i", when(s("arvalid_i"), [f"{address:03x}" for address in s("araddr_i")])), "rvalid_o", "rready_i",
             ("rdata_o", when(s("rvalid_o"), map(str, s("rdata_o")))), ("rresp_o", when(s("rvalid_o"), map(str, s("rresp_o")))),
             "awvalid_i", "awready_o", "wvalid_i", "wready_o", "bvalid_o"],
            ["c: the address of VERSION is taken, which reads 2.", "ffc is an unknown address: SLVERR (2). bready_i is 1."])


def ellipse_path(s):
    def own(word):  # the ellipse's A is larger than what other beats hold in its place
        values = s(f"u_ellipse.{word}")
        return when([value == max(values) for value in values], ["S1"] * len(values))
    words = [("e1", "u_setup.a_q[1]"), ("e5", "u_setup.a_q[5]"), ("e8", "u_setup.word_q[2]"), ("e9", "u_walk.u2_o"), ("e10", "u_lanes.u2_q")]
    return ("Splat path of a device with ellipses: an ellipse of two windows between two circles; every window reaches c0 ten cycles later",
            "w", cycles(s("u_decode.issues"))[0], [(-1, 25)],
            [decode(s), ("window issued", "u_decode.issues"), *((name, own(word)) for name, word in words), *windows(s),
             "tap_snap_valid_o", "tap_window_valid_o", "tap_sheet_valid_o"],
            ["w: decode issues the first window. E1: the ellipse with tag 1; S1: its windows.", TOKEN])


def every_sample(s):
    path = dict(windows(s))
    path = [(name, path[name]) for name in ("c0", "c1", "c2", "c3", "c4", "c5")] + [("c6 = k1", path["c6 = A"])]
    forwarded = both([int(banks > 0) for banks in s("u_compositor.sample_forward_2")], s("u_compositor.valid_q", 2))
    return ("Every sample: the second window lies over the first one and waits a cycle; windows pass c0 to k6, and states are forwarded",
            "w", cycles(s("u_decode.issues"))[0], [(-1, 17)],
            [decode(s), ("window issued", "u_decode.issues"), ("window waits", "u_decode.stall_hazard_o"), *path,
             *list(pipe(s, ["S0", "S1", "S2", "S3"]))[1:], ("k5's state to k3", forwarded), "tap_window_valid_o", "tap_composite_valid_o"],
            ["w: decode issues the first window. " + TOKEN, "S0, S1 and S3 lie at one place, S2 beside it."])


def density_walk(s):
    def blocks(signal):
        return nth(s(f"u_densities.{signal}"), ["D0", "D1"])
    steps = [("ALRBH"[step.bit_length() - 1], f"D{sheet}") if step else None for step, sheet in zip(s("u_densities.step"), s("u_densities.sheet"))]
    return ("Densities: once the second sheet is copied, the first is walked, passes the pixel stage and is composited; the second follows at end_tile",
            "f", cycles(s("u_densities.finish_i"))[1], [(-2, 10), (29, 44)],
            [("copy", blocks("copy_i")), ("end_tile's turn", "u_decode.tile_flush_o"), ("walk", steps), ("d0", blocks("slice_valid")),
             ("d1", blocks("u_valid.gen_stages.stage_q[0]")), ("d22 = k0", blocks("valid_o")), *pipe(s, ["D0", "D1"]), *COMPOSITED,
             ("at rest", "u_compositor.idle_o")],
            ["f: the second sheet's last block is copied. D0, D1: the only block of each sheet, one slice (R = 1).",
             "Walk: reads the words above, left, right and below (A, L, R, B) and the block's own (H). end_tile's turn begins in y."])


def tests(s, *registers):
    return [(f"t{n}", beats(s, "u_test.valid_q", f"u_test.beat_q[{n}]", n)) for n in registers] + [
        "verdict_valid_o", ("verdict_hidden_o", both(s("verdict_valid_o"), s("verdict_hidden_o")))]


def culling(s):
    return ("Culling: begin_sheet waits in t0 for its table; of two cull_blocks one is hidden, and its splat is dropped",
            "g", cycles(s("u_map.whole_o"))[0], [(-5, 10)],
            ["tap_composite_valid_o", ("table built", when(s("u_map.work_q"), [f"T{table}" for table in s("u_map.table_q")])),
             ("second register", beats(s, "u_check.beat_valid_q", "u_check.beat_q")), *tests(s, 0, 1, 2, 3), decode(s), ("window issued", "u_decode.issues")],
            ["g: the last row of table 0 (T0) is built. BS: the begin_sheet that waits for it.",
             "C2, C3: cull_blocks of the splats S2 and S3. S2 takes a cycle in decode and issues no window."])


def fetch(s):
    taken = both(s("u_fetch.s_axis_cmd_tvalid"), s("u_fetch.s_axis_cmd_tready"))
    bursts = [(str(length + 1), address) for length, address in zip(s("u_fetch.m_axi_arlen"), s("u_fetch.m_axi_araddr"))]
    return ("Fetch: a command's beats are read and sent; of its two sets one is hidden, and only the other one's splat is read",
            "c", cycles(taken)[1], [(-1, 29)],
            [("command taken", taken), ("m_axi_ar, beats", when(s("u_fetch.m_axi_arvalid"), bursts)),
             ("m_axi_r", beats(s, "u_fetch.m_axi_rvalid", "u_fetch.m_axi_rdata")), ("m_axis", beats(s, "u_fetch.m_axis_tvalid", "u_fetch.m_axis_tdata")),
             *tests(s, 0, 3), ("run taken", "u_fetch.run_take")],
            ["c: the command is taken. The memory answers after M = 4 cycles. ES, BS, ET: end_sheet, begin_sheet, end_tile.",
             "C4, C5: cull_blocks of the splats S4, which is hidden and not read, and S5."])


def runs():
    """By simulation: what is added to `tiny`, its stream, its pictures."""
    four = [(2, 0), (2, 0), (4, 0), (2, 0)]
    broken = tile(0, 8, 8, [(2, 2, 1), (2, 2, 1), (2, 2), (2, 2)], number=1)
    broken[4] += 7 << 32  # the tag: 9 in the place of 2
    yield "slices", "composite", "lanes = 2", [(tile(0, 5, 2, four), []), (broken, [])], {
        "check": check, "splat": splat_path, "compositor": compositor, "pixel-out": pixel_out, "registers": registers}
    shaped = tile(0, 8, 2, [(2, 0), (2, 0), (4, 0)])
    shaped[3] = beat("E", 1, 2 * 8 | 1 << 22, 0, 0, 255 << 16, 4096, 4096)  # a row of two windows
    yield "ellipses", "ellipse", "frac_bits = 4", [(shaped, [])], {"ellipse": ellipse_path}
    yield "samples", "composite", "every_sample = 1", [(tile(4, 8, 2, four), [])], {"every-sample": every_sample}
    yield "densities", "classify", "segment_bits = 1", [(tile(8, 6, 2, [(1, -1)], [(1, -1)]), [])], {"densities": density_walk}
    sets = [[beat("C", tag + i, 2 + 2 * i, 0, 2 | 2 << 16, 1) for i in (0, 1)] for tag in (2, 4)]
    words = tile(0, 8, 4, [(2, 0), (2, 0)], [], [(2, 0), (4, 0)], [(2, 0), (4, 0)])
    yield "culled", "cull", 'map = "block"', [(words[:8] + sets[0], words[8:10]), (words[10:12] + sets[1], words[12:14]), (words[14:], [])], {
        "culling": culling, "fetch": fetch}


def main(root, emit, folder, *checks):
    committed, made = f"{root}/docs/images/timing", {}
    for run, section, key, parts, pictures in runs():
        s = simulate(root, emit, f"{folder}/{run}", section, key, parts)
        for name, picture in pictures.items():
            *begin, rows, notes = picture(s)
            rows = [(row, row) if isinstance(row, str) else row for row in rows]
            rows = [(row, s(values) if isinstance(values, str) else values) for row, values in rows]
            made[f"{name}.svg"] = draw(*begin, rows, notes)
    target = f"{folder}/new" if checks else committed
    os.makedirs(target, exist_ok=True)
    for name, svg in made.items():
        pathlib.Path(target, name).write_text(svg)
    kept = {path.name: path.read_text() for path in pathlib.Path(committed).glob("*")}
    different = sorted(name for name in made.keys() | kept.keys() if made.get(name) != kept.get(name))
    print(f"[figure] timing diagrams = {len(made)}, different ones = {len(different)} (limit 0)")
    if different:
        raise SystemExit(f"timing: error: docs/images/timing/{different[0]} is not what the RTL shows; run tools/timing, look at the change, commit")


if __name__ == "__main__":
    main(*sys.argv[1:])

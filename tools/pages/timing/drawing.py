# SPDX-License-Identifier: Apache-2.0
"""A timing diagram as SVG."""
CYCLE, ROW, CUT, TOP, BYTES, WIDTH = 22, 22, 16, 28, 15000, 900
FILLS = ["#cfe3fa", "#fde7b0", "#cdeed6", "#f6cfd4", "#e2d6f5", "#d5eef0", "#e4e4e0", "#f3dcc4"]


def draw(title, event, zero, spans, rows, notes):
    """`event` names cycle `zero` of the rows' values. `spans`: first and last cycles that are shown, counted from it, with a cut between two of
    them. A row is a name and its values by cycle: 0 or 1 of a wire; None, a text or (text, what gives it its colour) of a register."""
    names = [f"cycles from {event}"] + [name for name, _ in rows]
    x = left = 14 + round(7.3 * max(map(len, names)))
    bottom = TOP + len(rows) * ROW
    grid, cuts, wires, boxes, texts, colours, shown = "", "", "", {}, [], {}, [set() for _ in rows]
    for first, last in spans:
        if x > left:
            wave = "q4 5.5 0 11" + "t0 11" * (bottom // ROW * 2 - 2)
            cuts += f"M{x + 5} {TOP - 6}{wave}M{x + 10} {TOP - 6}{wave}"
            x += CUT
        for i, cycle in enumerate(range(first, last + 2)):
            grid += f"M{x + i * CYCLE} {TOP - 4}V{bottom}"
            texts += [(x + (i + 0.5) * CYCLE, TOP - 10, str(cycle).replace("-", "−") if cycle else event)] if cycle <= last else []
        for number, (_, values) in enumerate(rows):
            y, part = TOP + number * ROW, values[zero + first:zero + last + 1]
            starts = [i for i, value in enumerate(part) if i == 0 or value != part[i - 1]]
            for start, end in zip(starts, starts[1:] + [len(part)]):
                value, at, length = part[start], x + start * CYCLE, (end - start) * CYCLE
                shown[number].add(value)
                if isinstance(value, int):
                    wires += f"{'V' if start else f'M{at} '}{y + (4 if value else 18)}H{at + length}"
                elif value is not None:
                    text, key = value if isinstance(value, tuple) else (value, value)
                    fill = colours.setdefault(key, FILLS[len(colours) % len(FILLS)])
                    boxes[fill] = boxes.get(fill, "") + f"M{at} {y + 3}h{length}v16h-{length}z"
                    texts.append((at + length / 2, y + 15, text))
        x += (last - first + 1) * CYCLE
    width, height = max(x, *(7 * len(note) for note in notes)) + 8, bottom + 8 + 17 * len(notes)
    svg = "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" font-size="11" '
        'font-family="Helvetica, Arial, sans-serif" fill="#24292f">', f"<title>{title}</title>", f'<rect width="{width}" height="{height}" fill="#fff"/>',
        f'<path d="{grid}" stroke="#dfe3e8"/>', '<g stroke="#6e7781">', *(f'<path fill="{fill}" d="{path}"/>' for fill, path in boxes.items()), "</g>",
        f'<g fill="none"><path d="{wires}" stroke="#0550ae" stroke-width="1.5"/><path d="{cuts}" stroke="#57606a"/></g>', '<g text-anchor="middle">',
        *(f'<text x="{x:g}" y="{y}">{text}</text>' for x, y, text in texts), '</g><g text-anchor="end" font-family="monospace" font-size="12">',
        *(f'<text x="{left - 6}" y="{TOP + i * ROW - (10 if i == 0 else 7)}">{name}</text>' for i, name in enumerate(names)), '</g><g font-size="12">',
        *(f'<text x="8" y="{bottom + 17 + 17 * i}">{note}</text>' for i, note in enumerate(notes)), "</g>", "</svg>", ""])
    still = [names[i + 1] for i, values in enumerate(shown) if len(values) < 2]
    if still or width > WIDTH or len(svg.encode()) > BYTES:
        raise SystemExit(f"timing: error: {title}: {width} pixels wide, {len(svg.encode())} bytes, rows without a change: {still}; expected at most "
                         f"{WIDTH}, {BYTES} and none")
    return svg

# SPDX-License-Identifier: Apache-2.0
"""Tokens of SystemVerilog and of C++, with their places: enough to find expressions, nothing more."""
import re
from typing import NamedTuple


class Token(NamedTuple):
    kind: str  # name, number, string, macro or operator
    text: str
    start: int  # characters of the source
    end: int
    line: int  # from 1


# `(* attribute *)` and a macro's line ends count as space.
_SPACE = r"\s+|\\\n|//[^\n]*|/\*.*?\*/"
_SYSTEMVERILOG = re.compile(
    rf"""(?P<space>{_SPACE}|\(\*\s.*?\*\))
    |(?P<string>"(?:[^"\\]|\\.)*"|`"[^`]*`")
    |(?P<number>\d*'s?[bdhoBDHO][0-9a-fA-FxXzZ_?]+|'[01]|\d[\d_]*)
    |(?P<macro>`[A-Za-z_]\w*)
    |(?P<name>[A-Za-z_$][\w$]*(?:``\w+)*)
    |(?P<operator><<<|>>>|\|=>|\|->|<<|>>|<=|>=|===|!==|==|!=|&&|\|\||::|\+:|-:|\+\+|--|~\^|~&|~\||[-+*/%&|^~!<>=?:;,.@#'(){{}}\[\]`])""",
    re.S | re.X)
_CPLUSPLUS = re.compile(
    rf"""(?P<space>{_SPACE}|\#(?:\\\n|[^\n])*)
    |(?P<string>(?:u8|L|u|U)?"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)+')
    |(?P<number>(?:0[xX][0-9a-fA-F']+|\d[\d']*\.?\d*(?:[eE][-+]?\d+)?|\.\d+)[uUlLfF]*)
    |(?P<name>[A-Za-z_]\w*)
    |(?P<operator><=>|<<=|>>=|\.\.\.|->\*|->|::|<<|>>|<=|>=|==|!=|&&|\|\||\+\+|--|[-+*/%&|^]=|[-+*/%&|^~!<>=?:;,.@#(){{}}\[\]])""",
    re.S | re.X)
_PATTERNS = {"systemverilog": _SYSTEMVERILOG, "cplusplus": _CPLUSPLUS}


def tokens_of(source: str, language: str) -> list[Token]:
    """The tokens in order; ValueError, with the line, where none fits."""
    out, at, line = [], 0, 1
    while at < len(source):
        match = _PATTERNS[language].match(source, at)
        if match is None:
            raise ValueError(f"line {line}: no token: {source[at:at + 20]!r}")
        if match.lastgroup != "space":
            out.append(Token(match.lastgroup, match.group(), at, match.end(), line))
        line += match.group().count("\n")
        at = match.end()
    return out


def joined(tokens: list[Token]) -> str:
    """Their text in one line: a space where the source has any, comments gone."""
    out, end = "", None
    for token in tokens:
        out += (" " if end is not None and token.start > end else "") + token.text
        end = token.end
    return out


def closing(tokens: list[Token], at: int) -> int:
    """Index of the bracket that closes the one at `at`."""
    pairs, depth = {"(": ")", "[": "]", "{": "}"}, []
    for i in range(at, len(tokens)):
        text = tokens[i].text
        if tokens[i].kind != "operator":
            continue
        if text in pairs:
            depth.append(pairs[text])
        elif depth and text == depth[-1]:
            depth.pop()
            if not depth:
                return i
    raise ValueError(f"line {tokens[at].line}: {tokens[at].text} is never closed")

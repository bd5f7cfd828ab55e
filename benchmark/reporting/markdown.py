# SPDX-License-Identifier: Apache-2.0
"""Markdown from rows of cells."""


def row(cells):
    return "| " + " | ".join(map(str, cells)) + " |"


def table(head, rows):
    return "\n".join([row(head), "|---" * len(head) + "|", *map(row, rows)])


def size(n):
    return f"{n >> 20} Mi" if n % (1 << 20) == 0 else f"{n >> 10} Ki"

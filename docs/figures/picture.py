# SPDX-License-Identifier: Apache-2.0
"""Rows of requests and lanes as SVG: what the figures are made of. Colours are those of Okabe and Ito, and
every coloured cell has a letter as well."""
from lanes import COSTS, SHADERS, WARP, BATCH

CELL, GAP, LEFT, WIDTH = 20, 6, 21, 380
STYLE = """<style>
.card{fill:#fff;stroke:#d0d0d0} text{font:12px sans-serif;fill:#222;text-anchor:middle} .say{text-anchor:start}
.head{font-weight:bold;text-anchor:start} .small{font-size:11px;fill:#595959}
.A{fill:#e69f00} .B{fill:#56b4e9} .C{fill:#009e73} .D{fill:#cc79a7} .on{fill:#111} .off{fill:#eee}
.wait{fill:none;stroke:#999} .none{fill:none;stroke:#999;stroke-dasharray:2 3} .line{fill:none;stroke:#777}
@media (prefers-color-scheme:dark){.card{fill:#16191d;stroke:#444} text{fill:#e8e8e8} .small{fill:#b0b0b0}
.on{fill:#111} .off{fill:#2b2f35} .wait,.none{stroke:#777} .line{stroke:#999}}
</style>"""


def column(position):
    """Where the cell at a position begins: there is a gap between warps."""
    return LEFT + position * CELL + position // WARP * GAP


class Picture:
    def __init__(self, title):
        self.title, self.out, self.y = title, [], 10

    def text(self, x, y, words, kind="say"):
        self.out.append(f'<text class="{kind}" x="{x:g}" y="{y:g}">{words}</text>')

    def head(self, words):
        self.y += 22
        self.text(LEFT, self.y - 5, words, "head")

    def say(self, words):
        self.y += 18
        self.text(LEFT, self.y - 4, words)

    def space(self, height=8):
        self.y += height

    def cell(self, position, letter, kind=None, y=None):
        """A cell with a letter: coloured by it, or of another kind."""
        x, y = column(position), self.y if y is None else y
        self.out.append(f'<rect class="{kind or letter}" x="{x + 1}" y="{y + 1}" width="18" height="18" rx="3"/>')
        if letter:
            self.text(x + 10, y + 14.5, letter, "on" if kind is None else "small")

    def numbers(self, values, start=0):
        """A row of small numbers, under or above cells."""
        for position, value in enumerate(values, start):
            self.text(column(position) + 10, self.y + 10, value, "small")
        self.y += 14

    def requests(self, order, start=0, indices=True):
        """Requests in an order: the shader of each in a cell, its index below; None leaves a place empty."""
        for position, request in enumerate(order, start):
            if request is None:
                self.cell(position, "", "none")
            else:
                self.cell(position, BATCH[request])
        self.y += CELL
        if indices:
            self.numbers(["" if r is None else r for r in order], start)

    def warps(self, names, size=WARP):
        """Brackets under groups of lanes."""
        for number, name in enumerate(names):
            first, last = column(number * size) + 2, column((number + 1) * size - 1) + CELL - 2
            self.out.append(f'<path class="line" d="M{first} {self.y + 1}v5H{last}v-5"/>')
            self.text((first + last) / 2, self.y + 18, name, "small")
        self.y += 24

    def time(self, warps, start=0):
        """Lanes as columns, steps downwards. A lane at work has the letter of its shader; one that waits is
        empty; one that has no request is dashed."""
        steps = [warp.steps() for warp in warps]
        for number, warp in enumerate(warps):
            for step, shader in enumerate(steps[number]):
                for lane in range(WARP):
                    position, y = start + number * WARP + lane, self.y + step * CELL
                    if warp.at_work(lane, shader):
                        self.cell(position, shader, None, y)
                    else:
                        self.cell(position, "", "none" if warp.requests[lane] is None else "wait", y)
        self.y += max(map(len, steps)) * CELL

    def costs(self):
        """What the shaders cost."""
        x = LEFT
        for shader in SHADERS:
            for step in range(COSTS[shader]):
                self.out.append(f'<rect class="{shader}" x="{x + 1}" y="{self.y + 1 + step * CELL}" width="18" '
                                'height="18" rx="3"/>')
                self.text(x + 10, self.y + 14.5 + step * CELL, shader, "on")
            self.text(x + 26, self.y + 15, f"{COSTS[shader]} step{'s' if COSTS[shader] > 1 else ''}")
            x += 86
        self.y += max(COSTS.values()) * CELL

    def result(self, run):
        self.space(4)
        self.say(f"{run.active()} of {run.held()} lane-steps are work: {run.efficiency():.0%}")

    def bar(self, name, run):
        """A bar of a run's efficiency, with the name and the numbers above it."""
        self.say(f"{name}: {run.active()} of {run.held()}, {run.efficiency():.0%}")
        width = WIDTH - 2 * LEFT
        self.out.append(f'<rect class="off" x="{LEFT}" y="{self.y}" width="{width}" height="10" rx="3"/>')
        self.out.append(f'<rect class="B" x="{LEFT}" y="{self.y}" width="{width * run.efficiency():.1f}" '
                        'height="10" rx="3"/>')
        self.y += 16

    def svg(self):
        height = self.y + 12
        return "\n".join([
            f'<svg xmlns="http://www.w3.org/2000/svg" width="500" height="{height * 500 / WIDTH:.0f}" '
            f'viewBox="0 0 {WIDTH} {height:g}" role="img">', f"<title>{self.title}</title>", STYLE,
            f'<rect class="card" x="0.5" y="0.5" width="{WIDTH - 1}" height="{height - 1:g}" rx="6"/>',
            *self.out, "</svg>", ""])

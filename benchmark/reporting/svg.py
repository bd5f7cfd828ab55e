# SPDX-License-Identifier: Apache-2.0
"""A drawing as SVG text: the same bytes for the same calls, light and dark by the reader's preference, in colours after
Okabe and Ito, which colour-blind readers tell apart, and narrow enough for a phone: letters have 11 pixels there."""
import html
import math

SERIES = 6  # colours, .s0 to .s5
STYLE = """<style>
text{font:14px sans-serif;fill:#1b1b1b} .soft{fill:#555} .small{font-size:13px} .strong{font-weight:bold}
.back{fill:#fff} .grid{stroke:#ddd} .axis{stroke:#777} .band{fill:#999;opacity:.3} .guide{stroke:#777;stroke-dasharray:5 4}
.axis,.guide{fill:none} .line{fill:none;stroke-width:1.8} .thin{stroke-width:1.2} .open{fill:#fff;stroke-width:1.8}
.s0{color:#0072b2} .s1{color:#d55e00} .s2{color:#009e73} .s3{color:#b0568c} .s4{color:#b37700} .s5{color:#1b1b1b}
.fill{fill:currentColor} .line,.thin,.open{stroke:currentColor}
@media (prefers-color-scheme:dark){text{fill:#eee} .soft{fill:#b5b5b5} .back,.open{fill:#0d1117} .grid{stroke:#30363d}
.axis,.guide{stroke:#8b949e} .s0{color:#56b4e9} .s1{color:#f0803c} .s2{color:#2fc79a} .s3{color:#cc79a7} .s4{color:#e69f00}
.s5{color:#eee}}
</style>"""


def number(value):
    return f"{value:.1f}".removesuffix(".0")


class Drawing:
    """What is drawn later lies above what is drawn before."""

    def __init__(self, width, height, description):
        self.head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
                     f'viewBox="0 0 {width} {height}" role="img" aria-label="{html.escape(description)}">')
        self.parts = [f'<rect class="back" width="{width}" height="{height}"/>']

    def text(self, x, y, words, look="", anchor="start", turned=False):
        turn = f' transform="rotate(-90 {number(x)} {number(y)})"' if turned else ""
        self.parts.append(f'<text class="{look}" x="{number(x)}" y="{number(y)}" text-anchor="{anchor}"{turn}>'
                          f"{html.escape(words)}</text>")

    def line(self, points, look):
        where = " ".join(f"{number(x)},{number(y)}" for x, y in points)
        self.parts.append(f'<polyline class="{look}" points="{where}"/>')

    def rect(self, x, y, width, height, look):
        self.parts.append(f'<rect class="{look}" x="{number(x)}" y="{number(y)}" width="{number(width)}" '
                          f'height="{number(height)}"/>')

    def mark(self, shape, x, y, look, tip=""):
        """A disc, or an open diamond or square; `tip` is shown where a pointer rests on it."""
        title = f"<title>{html.escape(tip)}</title>" if tip else ""
        if shape == "disc":
            self.parts.append(f'<circle class="fill {look}" cx="{number(x)}" cy="{number(y)}" r="4">{title}</circle>')
            return
        r = 4.6 if shape == "diamond" else 3.6
        turn = f' transform="rotate(45 {number(x)} {number(y)})"' if shape == "diamond" else ""
        r = r / math.sqrt(2) * 1.1 if shape == "diamond" else r
        self.parts.append(f'<rect class="open {look}" x="{number(x - r)}" y="{number(y - r)}" width="{number(2 * r)}" '
                          f'height="{number(2 * r)}"{turn}>{title}</rect>')

    def render(self):
        return "\n".join([self.head, STYLE, *self.parts, "</svg>"]) + "\n"


class LogScale:
    """From values to places along an axis, by their logarithms."""

    def __init__(self, low, high, begin, end):
        self.low, self.high, self.begin, self.end = low, high, begin, end

    def __call__(self, value):
        share = math.log(value / self.low) / math.log(self.high / self.low)
        return self.begin + share * (self.end - self.begin)

    def doublings(self):
        """The powers of two between the ends."""
        first, last = math.ceil(math.log2(self.low) - 1e-9), math.floor(math.log2(self.high) + 1e-9)
        return [2.0 ** k for k in range(first, last + 1)]

    def round_values(self):
        """1, 2 and 5 times powers of ten between the ends."""
        decades = range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)) + 1)
        return [m * 10.0 ** k for k in decades for m in (1, 2, 5)
                if self.low * 0.999 <= m * 10.0 ** k <= self.high * 1.001]


def plain(value):
    """A value of an axis: no zeros behind what it needs."""
    return f"{value:.3g}" if value < 1000 else f"{value:.0f}"


def apart(places, gap):
    """The places moved as little as need be to lie `gap` apart, in their order."""
    order = sorted(range(len(places)), key=lambda k: places[k])
    groups = []  # [members, centre]
    for k in order:
        groups.append([[k], places[k]])
        while len(groups) > 1 and groups[-1][1] - groups[-2][1] < gap * (len(groups[-1][0]) + len(groups[-2][0])) / 2:
            members = groups[-2][0] + groups[-1][0]
            del groups[-2:]
            centre = sum(places[m] - gap * i for i, m in enumerate(members)) / len(members) + gap * (len(members) - 1) / 2
            groups.append([members, centre])
    moved = list(places)
    for members, centre in groups:
        for i, m in enumerate(members):
            moved[m] = centre + gap * (i - (len(members) - 1) / 2)
    return moved

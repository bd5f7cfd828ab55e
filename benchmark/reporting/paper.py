# SPDX-License-Identifier: Apache-2.0
"""What Hoberock, Lu, Jia and Hart found in 2009, and where to look for it in the raw data."""
from dataclasses import dataclass

SCHEDULES = ["explicit", "compact+implicit", "compact+explicit", "sort+implicit", "sort+explicit", "local-bitonic"]
LATER = ["bucket+implicit", "bucket+explicit", "local", "window"]
GROUPINGS = ("compact", "sort", "bucket")


@dataclass(frozen=True)
class Scene:
    """A set of shaders that stands for one of the paper's scenes, and what the paper says of that: from `low` to
    `high` per cent slower or faster than unsorted implicit serialisation, or so many times as fast."""
    name: str
    low: float
    high: float
    unit: str

    def speedup(self):
        if self.unit == "times":
            return self.low, self.high
        if self.unit == "faster":
            return 1 + self.low / 100, 1 + self.high / 100
        return 1 / (1 + self.high / 100), 1 / (1 + self.low / 100)

    def words(self):
        if self.unit == "times":
            return f"{self.low} to {self.high} times as fast"
        return f"{self.low} to {self.high} % {self.unit}"

    def pays(self):
        return self.unit != "slower"

    def file(self):
        """The name of its files in examples/scenes/paper and docs/scenes, without an ending."""
        return self.name.replace(" + ", " ").replace(" ", "-")


SCENES = [Scene("3 simple", 5, 19, "slower"), Scene("6 simple", 14, 38, "faster"),
          Scene("2 simple + 2 procedural", 2.4, 2.7, "times"), Scene("3 simple + 2 procedural", 3.2, 3.5, "times"),
          Scene("11 moderate", 23, 51, "faster")]
EFFICIENCY = (98, 56, 52, 54)  # per cent, hit by hit


def unsorted(rows):
    """The time of unsorted implicit serialisation, in which every shader loads and stores for itself."""
    return rows.get("switch", rows["implicit"])

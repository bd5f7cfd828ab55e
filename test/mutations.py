#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether the tests of hard cases can fail: puts naive formulas in and expects red.

    test/mutations.py                       # all of the table below, some minutes each on one core
    test/mutations.py --only fresnel,basis  # these
    test/mutations.py --list                # names, and the test that each must turn red
    test/mutations.py --check               # only whether each finds its text, which takes no time

Copies the sources to a temporary folder, or to --folder, which is kept: a second run compiles less. There it
builds path_tracer_tests of the hard cases alone, for the CPU, runs all tests of the table, which must be green,
and then for each mutation replaces its text (an error unless it occurs exactly once), builds, runs its test and
puts the text back. Prints "red" or "NOT DETECTED", and exits with 1 if a mutation was not detected, did not
compile, or the tests were red before.
"""
import argparse
import collections
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

root = pathlib.Path(__file__).resolve().parent.parent
sources = "examples/gltf_path_tracer/"
mutation = collections.namedtuple("mutation", "name file text naive test")

mutations = [
    mutation("fresnel", "shading/microfacet.hpp",
             """  real const step = (eta - 1) * (eta + 1), cos2 = cos_i * cos_i;
  real const bent2 = step + cos2;  // (eta cos_t)^2
  cos_t = 0;
  if (!(bent2 > 0) || eta == 0) return 1;
  real const bent = std::sqrt(bent2), both = cos_i + bent;
  cos_t = bent / eta;
  real const s = step / (both * both);
  real const ratio = both / (eta * eta * cos_i + bent);
  real const p = s * (1 - (eta * eta + 1) * cos2) * (ratio * ratio);
""",
             """  real const sin2_t = glm::max(1 - cos_i * cos_i, real(0)) / (eta * eta);
  cos_t = 0;
  if (!(sin2_t < 1)) return 1;
  cos_t = std::sqrt(1 - sin2_t);
  real const s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  real const p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
""", "Fresnel's equations hold at all angles and for indices next to one"),
    mutation("sine", "shading/microfacet.hpp", "(1 - cos_theta) * (1 + cos_theta)", "1 - cos_theta * cos_theta",
             "the sine of a direction next to the pole has all its digits"),
    mutation("basis", "scene/surface.hpp", "real const sign = n.z < 0 ? real(-1) : real(1);", "real const sign = 1;",
             "a frame about any normal is orthonormal"),
    mutation("gram-schmidt-once", "scene/surface.hpp", "if (length2 < real(0.25) * hint2)", "if (false)",
             "a frame stays orthonormal whatever tangent it is asked for"),
    mutation("moeller-trumbore", "scene/bvh.hpp",
             """    vec2 const pa{a.x - shear_.x * a.z, a.y - shear_.y * a.z};
    vec2 const pb{b.x - shear_.x * b.z, b.y - shear_.y * b.z};
    vec2 const pc{c.x - shear_.x * c.z, c.y - shear_.y * c.z};
    real u = pc.x * pb.y - pc.y * pb.x;
    real v = pa.x * pc.y - pa.y * pc.x;
    real w = pb.x * pa.y - pb.y * pa.x;
    if (u == 0 || v == 0 || w == 0) {  // on an edge: the sign needs the exact product
      u = edge(pc, pb);
      v = edge(pa, pc);
      w = edge(pb, pa);
    }
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
    real const det = u + v + w;
    if (det == 0) return false;
    real const t = distance(triangle, (u * a.z + v * b.z + w * c.z) / det) * shear_.z;
    if (!(t > 0 && t < h.t)) return false;
    h = {t, {v / det, w / det}, triangle.primitive};
""",
             """    vec3 const d = vec3{shear_.x, shear_.y, 1} / shear_.z, e1 = b - a, e2 = c - a;
    vec3 const p = glm::cross(d, e2);
    real const det = glm::dot(e1, p);
    if (det == 0) return false;
    real const u = -glm::dot(a, p) / det;
    vec3 const q = glm::cross(-a, e1);
    real const v = glm::dot(d, q) / det;
    if (u < 0 || v < 0 || u + v > 1) return false;
    real const t = glm::dot(e2, q) / det;
    if (!(t > 0 && t < h.t)) return false;
    h = {t, {u, v}, triangle.primitive};
""", "no ray leaks through a closed mesh"),
    mutation("strict-edges", "scene/bvh.hpp", "if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;",
             "if ((u <= 0 || v <= 0 || w <= 0) && (u >= 0 || v >= 0 || w >= 0)) return false;",
             "no ray leaks through a closed mesh"),
    mutation("no-offset", "scene/surface.hpp",
             "return position + (glm::dot(world, geometric) > 0 ? clearance : -clearance) * geometric;",
             "return glm::dot(world, geometric) == 2 ? world : position;",
             "no secondary ray meets the triangle that it starts on"),
    mutation("constant-offset", "scene/motion.hpp",
             "real clearance = 2 * epsilon * glm::dot(normal, reach);",
             "real clearance = glm::dot(normal, reach) < 0 ? real(0) : real(1e-4);",
             "a point near the origin of a huge tilted plane starts rays off it"),
    mutation("float-sum", "shading/sums.hpp", "total += glm::dvec3(v);", "total = glm::dvec3(vec3(total) + v);",
             "the mean of ten million samples is right to the last digit of a float"),
    mutation("unguarded-division", "shading/bsdf.hpp", "  if (!(v.pdf > 0)) return {};\n", "",
             "samples of a BSDF are finite for numbers at the ends of their range"),
    mutation("coarse-pick", "scene/lights.hpp", "u.y + rest * real(0x1p-24) >= entries", "u.y + 0 * rest >= entries",
             "a light is picked as often as its density says, were it a million times dimmer"),
    mutation("dark-lights", "scene/lights.cpp", "area(t);\n    if (!(w > 0)) continue;", "area(t);",
             "lights without area or radiance are never picked"),
    mutation("nan-passes", "scene/environment_map.cpp",
             "if (v >= 0 && v * intensity <= real(1e30) && v <= real(1e30)) continue;",
             "if (!(v < 0 || v * intensity > real(1e30) || v > real(1e30))) continue;",
             "a sky with a texel that no light can come from is refused"),
    mutation("phase", "effects/medium.hpp", "(1 - g) * (1 - g) + 2 * g * (1 - c)", "1 + g * g - 2 * g * c",
             "the phase function is exact next to its peak"),
    mutation("sheen-to-the-horizon", "shading/microfacet.hpp",
             "real const o = glm::max(wo.z, real(1e-4)), i = glm::max(wi.z, real(1e-4));",
             "real const o = wo.z, i = wi.z;",
             "layers over a white base give back no more than they get, and little less"),
    mutation("tangent-from-cosine", "shading/microfacet.hpp", "(m.x * m.x + m.y * m.y) / (alpha * alpha)",
             "(1 - m.z * m.z) / (alpha * alpha)",
             "a white metal loses what single scattering loses, at any roughness and angle"),
    mutation("squared-densities", "scene/lights.hpp",
             "  real const ratio = b / a;\n  return 1 / (1 + ratio * ratio);",
             "  return a * a / (a * a + b * b);",
             "the power heuristic holds for densities whose squares a float does not have"),
]


def run(command, log, **options):
    with open(log, "w", encoding="utf-8") as file:
        return subprocess.run(command, stdout=file, stderr=subprocess.STDOUT, check=False, **options).returncode


def copy_sources(to):
    """All that the build needs; of the path tracer's tests those of hard cases."""
    for name in ["CMakeLists.txt", "cmake", "include", "examples", "test", "packaging", "README.md", "LICENSE"]:
        if (root / name).is_dir():
            shutil.copytree(root / name, to / name, dirs_exist_ok=True, copy_function=copy_if_newer)
        elif (root / name).exists():
            copy_if_newer(root / name, to / name)
    for path in (to / "test/path_tracer").glob("*.cpp"):
        if not path.name.startswith("hard_"):
            path.unlink()


def copy_if_newer(source, to):
    """Leaves a file alone that is the same already, so that it is not compiled again."""
    source, to = pathlib.Path(source), pathlib.Path(to)
    if not to.exists() or to.read_bytes() != source.read_bytes():
        shutil.copy(source, to)
    return to


class build:
    def __init__(self, folder, jobs):
        self.source, self.binary, self.jobs = folder / "source", folder / "build", str(jobs)
        self.log = folder / "log.txt"

    def configure(self):
        # One backend and little optimisation: it is the tests that count, not their time.
        command = ["cmake", "-S", self.source, "-B", self.binary, "-DCMAKE_BUILD_TYPE=Release",
                   "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", "-DDEFERRED_SHADE_DEVICE_SYSTEM=CPP",
                   "-DDEFERRED_SHADE_BUILD_BENCHMARKS=OFF", "-DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON",
                   "-DCMAKE_DISABLE_FIND_PACKAGE_OpenMP=ON"]
        if shutil.which("ninja"):
            command += ["-G", "Ninja"]
        if shutil.which("ccache"):
            command += ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"]
        return run(command, self.log) == 0

    def compile(self):
        command = ["cmake", "--build", self.binary, "--target", "path_tracer_tests", "--", "-j" + self.jobs]
        return run(command, self.log) == 0

    def is_green(self, tests):
        # A comma stands between tests for Catch2; in a name it is escaped.
        names = ",".join(test.replace(",", "\\,") for test in tests)
        return run([self.binary / "test/path_tracer_tests", names], self.log) == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", help="names of mutations, separated by commas")
    parser.add_argument("--folder", type=pathlib.Path, help="where to build; kept, and of use for the next run")
    parser.add_argument("--jobs", type=int, default=1, help="of the build (default: 1)")
    parser.add_argument("--list", action="store_true", help="print the table and do nothing")
    parser.add_argument("--check", action="store_true", help="look for the texts and do nothing")
    arguments = parser.parse_args()
    chosen = mutations
    if arguments.only:
        names = arguments.only.split(",")
        chosen = [m for m in mutations if m.name in names]
        if len(chosen) != len(names):
            sys.exit("there is no such mutation among " + ", ".join(m.name for m in mutations))
    if arguments.list:
        for m in chosen:
            print(f"{m.name:24}{sources}{m.file:24}{m.test}")
        return
    if arguments.check:
        lost = [m.name for m in chosen if (root / sources / m.file).read_text(encoding="utf-8").count(m.text) != 1]
        sys.exit("not found exactly once: " + ", ".join(lost) if lost else 0)
    with tempfile.TemporaryDirectory() as temporary:
        folder = (arguments.folder or pathlib.Path(temporary)).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "source").mkdir(exist_ok=True)
        sys.exit(0 if check(build(folder, arguments.jobs), chosen) else 1)


def check(tests, chosen):
    copy_sources(tests.source)
    if not (tests.configure() and tests.compile() and tests.is_green({m.test: None for m in chosen})):
        print("the tests are red, or do not compile, as they are:\n" + tests.log.read_text(encoding="utf-8")[-3000:])
        return False
    good = True
    for m in chosen:
        start = time.monotonic()
        path = tests.source / sources / m.file
        original = path.read_text(encoding="utf-8")
        if original.count(m.text) != 1:
            verdict = f"its text occurs {original.count(m.text)} times in {m.file}"
        else:
            path.write_text(original.replace(m.text, m.naive), encoding="utf-8")
            if not tests.compile():
                verdict = "does not compile:\n" + tests.log.read_text(encoding="utf-8")[-2000:]
            else:
                verdict = "NOT DETECTED" if tests.is_green([m.test]) else "red"
            path.write_text(original, encoding="utf-8")
        good = good and verdict == "red"
        print(f"{m.name:24}{verdict:14}{time.monotonic() - start:6.0f} s", flush=True)
    return good


if __name__ == "__main__":
    main()

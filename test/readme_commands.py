#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs every command of the README, as it stands there: readme_commands.py CCCL...

Commands run in a copy of this tree. URL stands for this repository, PREFIX for
a temporary folder, and where /usr/local/cuda has no Thrust, the folders CCCL stand for it. Scripts that take minutes and
have tests of their own need only exist and parse. A command whose tool is not here is named and not run. A command that
the table below does not know fails the test.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
OPTIONAL = {"git", "nvcc", "conan", "vcpkg"}
THRUST = "/usr/local/cuda/include/cccl"
PROJECT = "cmake_minimum_required(VERSION 3.22)\nproject(renderer LANGUAGES CXX)\nadd_executable(renderer renderer.cpp)\n"


class Failed(Exception):
    """What a command said."""


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", text, flags=re.DOTALL | re.MULTILINE)


def commands(text):
    """Every command of the blocks of a shell, without comments, and with its continued lines joined."""
    lines = "".join(blocks(text, "sh")).replace("\\\n", " ").splitlines()
    return [command for line in lines if (command := re.sub(r"(^|\s)#.*", "", line).strip())]


class Runner:
    def __init__(self, folder, cccl):
        self.folder, self.cccl, self.prefix = folder, cccl, folder / "prefix"
        self.tree = folder / "deferred_shade"
        shutil.copytree(root, self.tree, ignore=shutil.ignore_patterns("build", "out", ".git"))
        cccl_root = cccl[0] if len(cccl) == 1 else str(pathlib.Path(cccl[0]).parent)  # a checkout has three
        self.environment = {**os.environ, "CCCL_ROOT": cccl_root, "CONAN_HOME": str(folder / "conan"),
                            "OMP_WAIT_POLICY": "passive", "VCPKG_KEEP_ENV_VARS": "CCCL_ROOT"}

    def run(self, command, where=None, expected=""):
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", command], cwd=where or self.tree, env=self.environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if done.returncode or expected not in done.stdout:
            raise Failed(f"{command}\nended with {done.returncode} and should say '{expected}':\n{done.stdout[-2000:]}")

    def clone(self, command):
        if subprocess.run(["git", "-c", "safe.directory=*", "-C", str(root), "rev-parse"], capture_output=True,
                          check=False).returncode:
            print("not run, this is no repository:")
            return
        command = command.replace("git clone", "git -c safe.directory='*' clone").replace("URL", f"'{root}'")
        self.run(command + " && ls include", self.make_folder("clone"))

    def compile(self, command):
        if not pathlib.Path(THRUST).is_dir():
            command = command.replace(THRUST, " -isystem ".join(self.cccl))
        self.run(command, expected="0.5 0.9 0.5 0.0 0.9 0.5")

    def compile_for_gpu(self, command):
        if pathlib.Path("/dev/nvidiactl").exists():
            self.run(command, expected="2.0 0.5 2.0 8.0 0.5 8.0")
        else:
            self.run(command.split("&&")[0])

    def parse(self, command):
        script = root / command
        self.run(f"[[ -x '{script}' ]] && bash -n '{script}'")

    def install(self, command):
        self.run(command.replace("PREFIX", f"'{self.prefix}'"))

    def conan(self, command):
        self.run("conan profile detect --force && " + command)

    def vcpkg(self, command):
        self.run(f"{command} --x-install-root='{self.folder}/vcpkg'")

    def make_folder(self, name):
        (self.folder / name).mkdir()
        return self.folder / name

    def build(self, name, snippet, options):
        """Builds and runs a renderer that consists of the README's example, from a CMake snippet."""
        project = self.make_folder(name)
        (project / "CMakeLists.txt").write_text(PROJECT + snippet, encoding="utf-8")
        shutil.copy(root / "examples/01_shade.cpp", project / "renderer.cpp")
        self.run(f"cmake -S . -B build {options} && cmake --build build && build/renderer", project,
                 "0.5 0.9 0.5 0.0 0.9 0.5")


TABLE = {r"git clone URL \w+ && cd \w+": Runner.clone, r"g\+\+ .*": Runner.compile, r"nvcc .*": Runner.compile_for_gpu,
         r"scripts/[\w-]+": Runner.parse, r"cmake .* && cmake --install .* --prefix PREFIX": Runner.install,
         r"conan create \.": Runner.conan, r"vcpkg install .*": Runner.vcpkg}


def chosen(text):
    """(command, what runs it) of a page."""
    found = [(command, [how for pattern, how in TABLE.items() if re.fullmatch(pattern, command)])
             for command in commands(text)]
    if unknown := [command for command, how in found if not how]:
        raise Failed("nothing here runs: " + "; ".join(unknown))
    if missing := set(TABLE.values()) - {how[0] for _, how in found}:
        raise Failed("the README has no command for: " + ", ".join(sorted(how.__name__ for how in missing)))
    return [(command, how[0]) for command, how in found]


def main():
    text = (root / "README.md").read_text(encoding="utf-8")
    try:
        chosen(text.replace("scripts/demo", "scripts/demo now", 1))
        sys.exit("the check of commands itself is wrong: it takes one that it does not know")
    except Failed:
        pass
    snippet, = blocks(text, "cmake")
    package, = re.findall(r"`(find_package\([^`]+\))`", text)
    link = snippet.splitlines()[-1]
    with tempfile.TemporaryDirectory() as name:
        runner = Runner(pathlib.Path(name), sys.argv[1:])
        try:
            for script in re.findall(r"scripts/[\w-]+", text):
                runner.parse(script)
            for command, how in chosen(text):
                tool = command.split()[0]
                if tool in OPTIONAL and not shutil.which(tool):
                    print(f"not run, there is no {tool} here: {command}")
                    continue
                how(runner, command)
                print(f"ran: {command}", flush=True)
            runner.build("fetch_content", snippet, f"-DFETCHCONTENT_SOURCE_DIR_DEFERRED_SHADE='{root}'")
            runner.build("find_package", f"{package}\n{link}\n", f"-DCMAKE_PREFIX_PATH='{runner.prefix}'")
        except Failed as error:
            sys.exit(f"a command of the README fails: {error}")
    print("and both CMake snippets")


if __name__ == "__main__":
    main()

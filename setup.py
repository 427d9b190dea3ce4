"""Builds what the package for Python has in C++: veritrack-engine, veritrack-verify and the module _trackers.

VERITRACK_BUILD_FOLDER names a folder in which CMake has built the program already, with VERITRACK_BUILD_PYTHON;
without it all is compiled, which takes about ten minutes on two cores.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).parent.resolve()


class CMakeBuild(build_ext):
    def run(self):
        given = os.environ.get("VERITRACK_BUILD_FOLDER")
        folder = pathlib.Path(given) if given else ROOT / "build" / "wheel"
        if not given:
            subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DCMAKE_CXX_COMPILER=g++", "-DCMAKE_UNITY_BUILD=ON", "-DVERITRACK_BUILD_TESTS=OFF",
                            "-DVERITRACK_BUILD_PYTHON=ON", f"-DVERITRACK_PYTHON={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", folder, "--parallel", str(os.cpu_count() or 1),
                        "--target", "veritrack_python"], check=True)
        built = folder / "python" / "veritrack"
        target = pathlib.Path(self.build_lib, "veritrack")
        (target / "bin").mkdir(parents=True, exist_ok=True)
        for name in ("veritrack-engine", "veritrack-verify", "veritrack-lift"):
            if (built / "bin" / name).exists() or name != "veritrack-lift":  # which needs LLVM
                shutil.copy(built / "bin" / name, target / "bin")
        shutil.copy(built / pathlib.Path(self.get_ext_filename("_trackers")).name, target)


setup(
    version=re.search(r"project\(veritrack VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1],
    ext_modules=[Extension("veritrack._trackers", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
)

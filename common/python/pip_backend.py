"""What pip calls to build the package: CMake does the work, and the result is packed as a wheel. Needs no other package.

Settings of CMake: pip install . --config-settings=NLMECH_PEERS=all (default: none, so that SUNDIALS, GSL and GeographicLib are not needed);
build-dir=DIR is the folder of the build (default build-python)."""
import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import zipfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
VERSION = re.search(r"project\(nlmech VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


def digest(data):
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    settings = {"build-dir": "build-python", "NLMECH_TESTS": "OFF", "NLMECH_BOOK": "OFF", "NLMECH_PEERS": "none",
                "CMAKE_BUILD_TYPE": "Release", "Python_EXECUTABLE": sys.executable, **(config_settings or {})}
    build = SOURCE / settings.pop("build-dir")
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    defined = (f"-D{name}={value}" for name, value in settings.items())
    subprocess.run(["cmake", "-S", SOURCE, "-B", build, *generator, *defined], check=True)
    jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))
    subprocess.run(["cmake", "--build", build, "--target", "python", "--parallel", jobs], check=True)
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{tag}-{tag}-{re.sub('[-.]', '_', sysconfig.get_platform())}"
    info = f"nlmech-{VERSION}.dist-info"
    files = {f"nlmech/{file.name}": file.read_bytes() for file in sorted((build / "python/nlmech").iterdir()) if file.is_file()}
    files[f"{info}/METADATA"] = (f"Metadata-Version: 2.1\nName: nlmech\nVersion: {VERSION}\n"
                                 "Summary: Nonlinear problems of structural and celestial mechanics\n"
                                 "Requires-Python: >=3.9\nRequires-Dist: numpy\n").encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: nlmech\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = [f"{path},sha256={digest(data)},{len(data)}\n" for path, data in files.items()]
    files[f"{info}/RECORD"] = "".join([*record, f"{info}/RECORD,,\n"]).encode()
    name = f"nlmech-{VERSION}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            wheel.writestr(path, data)
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("install from a checkout: pip install .")

#!/usr/bin/env python3
"""Packs the built module as a wheel, offline:  wheel.py MODULE.so VERSION DIRECTORY

A wheel is a zip file with the module, its stubs, and what pip wants to know of it.
"""
import base64
import hashlib
import pathlib
import sys
import sysconfig
import zipfile

HERE = pathlib.Path(__file__).resolve().parent


def wheel(module, version, directory):
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    about = f"dovetail-{version}.dist-info"
    files = {
        module.name: module.read_bytes(),
        "dovetail-stubs/__init__.pyi": (HERE / "dovetail.pyi").read_bytes(),
        f"{about}/LICENSE": (HERE.parent.parent / "LICENSE").read_bytes(),
        f"{about}/METADATA": (
            f"Metadata-Version: 2.1\nName: dovetail\nVersion: {version}\n"
            "Summary: Optimises dovetail profiles against fretting wear\nLicense: GPL-3.0-or-later\n"
            f"Requires-Python: =={sys.version_info.major}.{sys.version_info.minor}.*\nRequires-Dist: numpy\n").encode(),
        f"{about}/WHEEL": f"Wheel-Version: 1.0\nGenerator: wheel.py\nRoot-Is-Purelib: false\nTag: {tag}\n".encode(),
    }
    record = "".join(
        f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}\n"
        for name, data in files.items())
    files[f"{about}/RECORD"] = (record + f"{about}/RECORD,,\n").encode()
    path = directory / f"dovetail-{version}-{tag}.whl"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name)
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
    return path


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    print(wheel(pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])))

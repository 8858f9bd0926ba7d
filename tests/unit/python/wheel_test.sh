#!/usr/bin/env bash
# Packs the module as a wheel, installs it without the network into a new environment and imports it there:
#   wheel_test.sh PYTHON MODULE.so VERSION
set -eu
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
wheel=$("$1" "$here/../../../studies/python/wheel.py" "$2" "$3" "$scratch")
cd "$scratch"
# numpy is that of the system, where nothing may be downloaded. Debian's venv needs python3-venv for pip.
if "$1" -m venv --system-site-packages environment >log 2>&1; then
  environment/bin/python -m pip install --no-index --quiet "$wheel"
  python=environment/bin/python
else
  "$1" -m zipfile -e "$wheel" unpacked
  export PYTHONPATH=$scratch/unpacked
  python=$1
fi
"$python" - "$scratch" "$3" <<'PYTHON'
import importlib.metadata, pathlib, sys
import dovetail
assert pathlib.Path(dovetail.__file__).is_relative_to(sys.argv[1]), dovetail.__file__
assert dovetail.__version__ == importlib.metadata.version("dovetail") == sys.argv[2]
assert any(str(file) == "dovetail-stubs/__init__.pyi" for file in importlib.metadata.files("dovetail"))
PYTHON

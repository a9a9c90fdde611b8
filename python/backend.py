"""Builds the wheel of a package that is only files, so that pip needs no network: PEP 517 with the standard library."""
import base64
import hashlib
import pathlib
import tomllib
import zipfile
from collections.abc import Mapping

here = pathlib.Path(__file__).parent
project = tomllib.loads((here / "pyproject.toml").read_text())["project"]
name, version = project["name"], project["version"]
facts = f"{name}-{version}.dist-info"


def build_wheel(wheel_directory: str, config_settings: object = None, metadata_directory: str | None = None) -> str:
    """Write the wheel and return its file name (PEP 427)."""
    return _write(wheel_directory, {f"{name}/{path.relative_to(here / name).as_posix()}": path.read_bytes()
                                    for path in sorted((here / name).rglob("*"))
                                    if path.is_file() and path.suffix != ".pyc"})


def build_editable(wheel_directory: str, config_settings: object = None, metadata_directory: str | None = None) -> str:
    """Write a wheel that points to this folder (PEP 660)."""
    return _write(wheel_directory, {f"{name}.pth": f"{here.resolve()}\n".encode()})


def _write(folder: str, files: Mapping[str, bytes]) -> str:
    requires = "".join(f"Requires-Dist: {each}\n" for each in project["dependencies"])
    text = {
        "METADATA": f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\nSummary: {project['description']}\n"
                    f"Requires-Python: {project['requires-python']}\n{requires}",
        "WHEEL": f"Wheel-Version: 1.0\nGenerator: {name}\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
    }
    files = {**files, **{f"{facts}/{key}": value.encode() for key, value in text.items()}}
    record = ""
    for path, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{path},sha256={digest},{len(content)}\n"
    wheel = f"{name}-{version}-py3-none-any.whl"
    with zipfile.ZipFile(pathlib.Path(folder) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in files.items():
            archive.writestr(path, content)
        archive.writestr(f"{facts}/RECORD", f"{record}{facts}/RECORD,,\n")
    return wheel

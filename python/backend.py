"""Builds the wheel with the standard library, so that pip needs no network: PEP 517.

The wheel is only files, unless the setting `program` names the folder that umbrameter is installed in, `/usr` or the prefix of
`cmake --install`: then it carries that program, and is for this platform.
"""
import base64
import hashlib
import os
import pathlib
import tempfile
import time
import tomllib
import zipfile
from collections.abc import Collection, Mapping

here = pathlib.Path(__file__).parent
project = tomllib.loads((here / "pyproject.toml").read_text())["project"]
name, version = project["name"], project["version"]
facts = f"{name}-{version}.dist-info"
console_script = f"[console_scripts]\n{name} = {name}.program:run_bundled\n"


def build_wheel(wheel_directory: str, config_settings: Mapping[str, str] | None = None,
                metadata_directory: str | None = None) -> str:
    """Write the wheel and return its file name (PEP 427)."""
    files = {f"{name}/{path}": content for path, content in _files_of(here / name).items() if not path.endswith(".pyc")}
    prefix = (config_settings or {}).get("program")
    if not prefix:
        return _write(wheel_directory, files)
    import bundle  # beside this file

    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work) / "program"
        tag = bundle.bundle(pathlib.Path(prefix), folder)
        program = {f"{name}/program/{path}": content for path, content in _files_of(folder).items()}
        executable = {f"{name}/program/{path.relative_to(folder)}" for path in folder.rglob("*") if os.access(path, os.X_OK)}
        about = {f"{facts}/licenses/{package}": content for package, content in bundle.licences(folder).items()}
        about[f"{facts}/entry_points.txt"] = console_script.encode()
    return _write(wheel_directory, {**files, **program, **about}, tag, executable)


def build_editable(wheel_directory: str, config_settings: object = None, metadata_directory: str | None = None) -> str:
    """Write a wheel that points to this folder (PEP 660)."""
    return _write(wheel_directory, {f"{name}.pth": f"{here.resolve()}\n".encode()})


def _files_of(folder: pathlib.Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def _write(folder: str, files: Mapping[str, bytes], platform: str = "any", executable: Collection[str] = ()) -> str:
    requires = "".join(f"Requires-Dist: {each}\n" for each in project["dependencies"])
    is_pure = "true" if platform == "any" else "false"
    text = {
        "METADATA": f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\nSummary: {project['description']}\n"
                    f"Requires-Python: {project['requires-python']}\n{requires}",
        "WHEEL": f"Wheel-Version: 1.0\nGenerator: {name}\nRoot-Is-Purelib: {is_pure}\nTag: py3-none-{platform}\n",
    }
    files = {**files, **{f"{facts}/{key}": value.encode() for key, value in text.items()}}
    record = ""
    for path, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{path},sha256={digest},{len(content)}\n"
    files[f"{facts}/RECORD"] = f"{record}{facts}/RECORD,,\n".encode()
    wheel = f"{name}-{version}-py3-none-{platform}.whl"
    # The same files give the same bytes. A zip knows no time before 1980.
    epoch = max(int(os.environ.get("SOURCE_DATE_EPOCH", 0)), 315532800)
    with zipfile.ZipFile(pathlib.Path(folder) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in files.items():
            entry = zipfile.ZipInfo(path, time.gmtime(epoch)[:6])
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if path in executable else 0o100644) << 16
            archive.writestr(entry, content)
    return wheel

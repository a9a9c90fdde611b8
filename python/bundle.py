"""The program inside a wheel: as it is installed, with the libraries that it links and the fonts of its figures.

The C and C++ runtime and OpenGL stay the system's: a driver there may need a later one than that of the machine that builds.
All other libraries get names of their own, so that the driver does not take them for the system's.
"""
import hashlib
import pathlib
import platform
import re
import shutil
import subprocess

of_system = re.compile(r"(ld-linux.*|lib(c|m|dl|rt|pthread|resolv|util|stdc\+\+|gcc_s|atomic|mvec))\.so\.\d+")
fonts = [pathlib.Path("/usr/share/fonts/truetype/dejavu") / name for name in ("DejaVuSans.ttf", "DejaVuSans-Bold.ttf")]

launcher = """#!/bin/sh
here=$(dirname "$(readlink -f "$0")")
: "${FONTCONFIG_FILE:=$here/lib/fonts.conf}"
export FONTCONFIG_FILE
exec "$here/bin/umbrameter" "$@"
"""
fonts_conf = """<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "fonts.dtd">
<fontconfig>
  <include ignore_missing="yes">/etc/fonts/fonts.conf</include>
  <dir prefix="relative">../share/fonts</dir>
  <cachedir prefix="xdg">fontconfig</cachedir>
</fontconfig>
"""


def bundle(prefix: pathlib.Path, folder: pathlib.Path) -> str:
    """Copy the program that is installed in `prefix` into an empty folder, and return the platform tag of the wheel.

    Raises FileNotFoundError where the prefix has no program, or this machine no patchelf.
    """
    program = prefix / "bin" / "umbrameter"
    if not program.is_file():
        raise FileNotFoundError(f"{program} is missing: program= names the folder that umbrameter is installed in")
    if shutil.which("patchelf") is None:
        raise FileNotFoundError("patchelf is missing: install it, or run scripts/setup")
    for name in ("bin", "lib", "share/fonts"):
        (folder / name).mkdir(parents=True)
    shutil.copytree(prefix / "share" / "umbrameter", folder / "share" / "umbrameter")
    for font in fonts:
        shutil.copy(font, folder / "share" / "fonts")
    (folder / "lib" / "fonts.conf").write_text(fonts_conf)
    (folder / "umbrameter").write_text(launcher)
    (folder / "umbrameter").chmod(0o755)
    _copy_with_libraries(program, folder)
    elves = [folder / "bin" / "umbrameter", *(folder / "lib").glob("*.so*")]
    return f"manylinux_{'_'.join(map(str, max(map(_newest_glibc, elves))))}_{platform.machine()}"


def licences(folder: pathlib.Path) -> dict[str, bytes]:
    """The copyright files of the Debian packages whose libraries and fonts a bundle has, by package."""
    names = [re.sub(r"-[0-9a-f]{8}(?=\.so)", "", path.name) for path in sorted((folder / "lib").glob("*.so*"))]
    names += [font.name for font in fonts]
    listed = _output("dpkg-query", "--search", "*.so.*", *map(str, fonts))  # one query: each takes a second
    packages = {path.rpartition("/")[2]: package for package, path in re.findall(r"^([^:,]+).*: (/.*)$", listed, re.MULTILINE)}
    found = {}
    for name in names:
        text = pathlib.Path("/usr/share/doc") / packages.get(name, "") / "copyright"
        if not text.is_file():
            raise FileNotFoundError(f"{name} belongs to no Debian package with a copyright file")
        found[packages[name]] = text.read_bytes()
    return found


def _copy_with_libraries(program: pathlib.Path, folder: pathlib.Path) -> None:
    listed = re.findall(r"^\s*(\S+) => (/\S+) ", _output("ldd", str(program)), re.MULTILINE)
    libraries = {name: pathlib.Path(path) for name, path in listed if not of_system.fullmatch(name)}
    names = {name: name.replace(".so", f"-{hashlib.sha256(path.read_bytes()).hexdigest()[:8]}.so", 1)
             for name, path in libraries.items()}
    for name, path in libraries.items():
        _copy(path, folder / "lib" / names[name], names, "$ORIGIN")
        _output("patchelf", "--set-soname", names[name], str(folder / "lib" / names[name]))
    _copy(program, folder / "bin" / "umbrameter", names, "$ORIGIN/../lib")


def _copy(source: pathlib.Path, target: pathlib.Path, names: dict[str, str], search: str) -> None:
    shutil.copy(source, target)
    target.chmod(0o755)
    needed = [name for name in _output("patchelf", "--print-needed", str(source)).split() if name in names]
    # One kind of change at a time: patchelf 0.14 mixes up the texts of several.
    if needed:
        _output("patchelf", *(word for name in needed for word in ("--replace-needed", name, names[name])), str(target))
        _output("patchelf", "--set-rpath", search, str(target))


def _newest_glibc(path: pathlib.Path) -> tuple[int, int]:
    versions = [(int(major), int(minor)) for major, minor in re.findall(rb"GLIBC_(\d+)\.(\d+)", path.read_bytes())]
    return max(versions, default=(2, 0))


def _output(*command: str) -> str:
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout

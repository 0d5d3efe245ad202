#!/usr/bin/env python3
"""Adds the licences of the libraries in a wheel to it, and lists them.

Usage: wheel_licences.py WHEEL FOLDER

WHEEL comes from `auditwheel repair` on Debian: each library is one of an installed package, whose copyright file
(/usr/share/doc/PACKAGE/copyright) is put into the wheel's licenses/bundled. Writes the wheel to FOLDER, and the table
libraries.txt. Fails if the package of a library, or its copyright file, is not found.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


def run(*words):
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


def system_libraries():
    """The files behind the names of shared libraries, as the linker finds them."""
    found = {}
    for line in run("/sbin/ldconfig", "-p").splitlines():
        match = re.match(r"\s*(\S+) \(libc6,x86-64.*\) => (\S+)", line)
        if match:
            found.setdefault(match[1], pathlib.Path(match[2]))
    return found


def original(name, libraries):
    """The file that auditwheel copied: it renames libx.so.1 to libx-0123abcd.so.1."""
    plain = re.sub(r"-[0-9a-f]{8}(?=\.)", "", name)
    candidates = [path for soname, path in libraries.items() if plain in (soname, path.name, path.resolve().name)]
    if not candidates:
        sys.exit(f"wheel_licences.py: no library of the system is called {plain} ({name})")
    return candidates[0]


def package_of(path):
    """The Debian package that holds a file; its list may name the file without /usr."""
    real = path.resolve()
    for name in (real, str(real).removeprefix("/usr"), path, str(path).removeprefix("/usr")):
        done = subprocess.run(["dpkg", "-S", str(name)], capture_output=True, text=True)
        if done.returncode == 0:
            return done.stdout.split(":")[0]
    sys.exit(f"wheel_licences.py: {path} belongs to no Debian package")


def licences_in(text):
    """The short names in a copyright file of Debian's format; other files are to be read."""
    names = []
    for match in re.finditer(r"^License:\s*(\S.*)$", text, re.MULTILINE):
        if match[1].strip() not in names:
            names.append(match[1].strip())
    return ", ".join(names) or "see the file"


def main():
    wheel, folder = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    libraries = system_libraries()
    rows = []
    with tempfile.TemporaryDirectory() as temporary:
        run(sys.executable, "-m", "wheel", "unpack", "--dest", temporary, str(wheel))
        (root,) = pathlib.Path(temporary).iterdir()
        (info,) = root.glob("*.dist-info")
        licences = info / "licenses" / "bundled"
        licences.mkdir(parents=True, exist_ok=True)
        for library in sorted(root.glob("lichtmc.libs/*.so*")):
            package = package_of(original(library.name, libraries))
            copyright_file = pathlib.Path("/usr/share/doc") / package / "copyright"
            if not copyright_file.exists():
                sys.exit(f"wheel_licences.py: {copyright_file} of {library.name} does not exist")
            shutil.copyfile(copyright_file, licences / f"{package}.txt")
            version = run("dpkg-query", "-W", "-f=${Version}", package)
            text = copyright_file.read_text(errors="replace")
            rows.append((re.sub(r"-[0-9a-f]{8}(?=\.)", "", library.name), package, version,
                         f"{library.stat().st_size / 1e6:.1f} MB", licences_in(text)))
        heads = ("library", "package", "version", "size", "licences in its copyright file")
        widths = [max(len(row[k]) for row in [heads, *rows]) for k in range(4)]
        table = "\n".join("  ".join([*(row[k].ljust(widths[k]) for k in range(4)), row[4]]) for row in [heads, *rows]) + "\n"
        (licences / "libraries.txt").write_text(table)
        run(sys.executable, "-m", "wheel", "pack", "--dest-dir", str(folder), str(root))
    size = (folder / wheel.name).stat().st_size
    with (folder / "libraries.txt").open("a") as file:
        file.write(f"{wheel.name}: {size / 1e6:.1f} MB, {len(rows)} libraries\n{table}\n")


if __name__ == "__main__":
    main()

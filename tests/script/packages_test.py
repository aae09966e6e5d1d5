#!/usr/bin/env python3
"""The packages that ./mckibben installs bring every system header that the build has read.

    packages_test.py SCRIPT BUILD_FOLDER
"""

import re
import subprocess
import sys


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


def list_of(script, name):
    return re.search(name + r"=\(([^)]*)\)", script, re.S).group(1).split()


def owners(headers):
    found = set()
    for at in range(0, len(headers), 300):
        for line in output("dpkg", "-S", *headers[at:at + 300]).splitlines():
            found.add(line.split(":")[0])
    return found


def brought_by(packages):
    """They, and what they depend on."""
    known, new = set(), set(packages)
    while new:
        known |= new
        text = output("dpkg-query", "-W", "-f", "${Depends},${Pre-Depends},", *sorted(new))
        new = {re.split(r"[\s(:]", one.strip())[0] for one in re.split(r"[,|]", text)} - known - {""}
    return known


def main():
    script = open(sys.argv[1], encoding="utf-8").read()
    packages = [one for one in list_of(script, "build_packages") + list_of(script, "test_packages") + list_of(script, "python_packages")
                if not one.startswith('"')]
    headers = sorted(set(re.findall(r"^\s+(/usr/include/\S+)", output("ninja", "-C", sys.argv[2], "-t", "deps"), re.M)))
    assert len(headers) > 500, len(headers)
    needed, brought = owners(headers), brought_by(packages)
    assert needed, "dpkg knows none of them"
    assert needed <= brought, f"not installed by the script: {sorted(needed - brought)}"


main()

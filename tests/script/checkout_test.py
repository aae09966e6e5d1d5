#!/usr/bin/env python3
"""The script ./mckibben in a checkout that its user cannot write: a build that is there is run; otherwise, or if a
source is newer, the program is built in the user's cache. Its own verbs have a --help. Cmake is played by a stub.

    checkout_test.py SCRIPT
"""

import os
import shutil
import subprocess
import sys
import tempfile

CMAKE = """#!/bin/sh
case "$1" in
  --preset) mkdir -p "$4" ;;
  --build) printf '#!/bin/sh\\necho built in %s\\n' "$2" > "$2/mckibben"; chmod +x "$2/mckibben" ;;
esac
"""


def write(path, text, mode=0o644):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as file:
        file.write(text)
    os.chmod(path, mode)


def become_nobody():
    if os.getuid() == 0:  # root may write anywhere
        os.setgroups([])
        os.setgid(65534)
        os.setuid(65534)


def main():
    with tempfile.TemporaryDirectory() as root:
        os.chmod(root, 0o755)
        checkout, home = os.path.join(root, "checkout"), os.path.join(root, "home")
        os.mkdir(home)
        os.chmod(home, 0o777)
        write(os.path.join(root, "bin/cmake"), CMAKE, 0o755)
        for name in ("CMakeLists.txt", "CMakePresets.json", "cmake/a", "plant/a", "controllers/a", "sim/a", "third_party/a"):
            write(os.path.join(checkout, name), "")
        shutil.copy(sys.argv[1], os.path.join(checkout, "mckibben"))
        environment = os.environ | {"PATH": os.path.join(root, "bin") + ":" + os.environ["PATH"], "HOME": home}
        environment.pop("XDG_CACHE_HOME", None)

        def run(*arguments, **more):
            said = subprocess.run([os.path.join(checkout, "mckibben"), *(arguments or ["--version"])], env=environment | more,
                                  preexec_fn=become_nobody, capture_output=True, text=True, cwd=home, timeout=60)
            assert said.returncode == 0, (said.returncode, said.stderr)
            return said.stdout

        os.chmod(checkout, 0o555)
        for verb in ("python", "test", "bench", "package"):  # says what it does, and does nothing
            said = run(verb, "--help")
            assert said.startswith("./mckibben " + verb), said
            assert ("/usr/bin/python3 --help" in said) == (verb == "python"), said
        assert run("run", "--help").startswith("built in")
        assert run().startswith(f"built in {home}/.cache/mckibben/"), run()
        write(os.path.join(root, "bin/cmake"), "#!/bin/sh\nexit 1\n", 0o755)
        assert run().startswith("built in")  # nothing to build, nothing asked of cmake
        write(os.path.join(root, "bin/cmake"), CMAKE, 0o755)
        assert run(XDG_CACHE_HOME=home + "/other").startswith(f"built in {home}/other/mckibben/")
        os.chmod(checkout, 0o755)
        write(os.path.join(checkout, "build/release/mckibben"), "#!/bin/sh\necho as built\n", 0o755)
        for name in ("build/release", "build", ""):
            os.chmod(os.path.join(checkout, name), 0o555)
        assert run() == "as built\n", run()
        os.utime(os.path.join(checkout, "sim/a"), (2e9, 2e9))
        assert run().startswith(f"built in {home}/.cache/mckibben/"), run()


main()

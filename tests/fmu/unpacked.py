"""FMUs as an importer has them: written by `mckibben fmu`, unpacked, and run by the small importer of
importer.c. Both programs are the first arguments of whoever imports this.
"""
import os
import subprocess
import sys
import xml.etree.ElementTree as ET
import zipfile

PROGRAM, IMPORTER = sys.argv[1:3]


def run(*arguments, folder, status=0):
    done = subprocess.run([PROGRAM, *arguments], cwd=folder, text=True, capture_output=True)
    assert done.returncode == status, done.stderr
    return done


class Fmu:
    """One that was written and unpacked."""

    def __init__(self, folder, rig, version, *options):
        self.path, self.version = folder / f"{version}.fmu", version
        run("fmu", str(rig), "--fmi", version, "--out", str(self.path), *options, folder=folder)
        self.folder = folder / f"unpacked {version}"
        with zipfile.ZipFile(self.path) as archive:
            assert archive.testzip() is None
            archive.extractall(self.folder)
        self.description = ET.parse(self.folder / "modelDescription.xml").getroot()
        self.token = self.description.get("guid" if version == "2.0" else "instantiationToken")
        platform = "linux64" if version == "2.0" else "x86_64-linux"
        identifier = self.description.find("CoSimulation").get("modelIdentifier")
        self.library = self.folder / "binaries" / platform / f"{identifier}.so"
        self.variables = list(self.description.find("ModelVariables"))
        self.reference = {each.get("name"): int(each.get("valueReference")) for each in self.variables}

    def typed(self, variable):
        """The element that has unit, start, min and max, and its type."""
        return variable[0] if self.version == "2.0" else variable

    def answers(self, commands, token=None, locale={}):
        resources = self.folder / "resources"
        resources = resources.as_uri() if self.version == "2.0" else f"{resources}/"
        done = subprocess.run([IMPORTER, self.library, self.version[0], token or self.token, resources], text=True,
                              cwd=self.folder, input="\n".join(commands), capture_output=True, timeout=300,
                              env={**os.environ, **locale})
        assert done.returncode == 0, done.stderr
        return done.stdout.splitlines()

    def ride(self, currents, outputs, before=(), instance=0, tick=0.012):
        """Commands of a ride under these currents; outputs are asked for at each tick."""
        commands = [f"{instance} {line}" for line in before]
        commands += [f"{instance} set {self.reference['current']} {currents[0]}", f"{instance} init 0",
                     f"{instance} start", *self.look(outputs, instance)]
        for k, current in enumerate(currents[:-1]):
            commands += [f"{instance} set {self.reference['current']} {current}",
                         f"{instance} step {k * tick!r} {tick}", *self.look(outputs, instance)]
        return commands

    def look(self, outputs, instance=0):
        return [f"{instance} {'count' if name == 'counts' else 'get'} {self.reference[name]}" for name in outputs]

    def moved(self, output, *moves):
        """What an output reads after each move: inputs that are set, and ticks for which they hold."""
        commands, ticks = [], 0
        for k, (inputs, wanted) in enumerate(moves):
            commands += [f"0 set {self.reference[name]} {value}" for name, value in inputs.items()]
            commands += ["0 init 0", "0 start"] if k == 0 else []
            commands += [*self.on(range(ticks, ticks + wanted)), *self.look([output])]
            ticks += wanted
        return [float(answer) for answer in self.answers(commands)]

    def on(self, ticks, outputs=()):
        """Further ticks."""
        return [line for k in ticks for line in (f"0 step {k * 0.012!r} 0.012", *self.look(outputs))]

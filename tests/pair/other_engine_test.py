"""What another engine hides in one muscle of a pair is found there, with its size, and the corrected rig closes the
gap; seen from behind, it is the other muscle's."""
import json
import pathlib
import subprocess
import sys
import tempfile

import other_engine

program = sys.argv[1]
noise_rad, leak = 1e-3, 3e-10


def answer(*words):
    return json.loads(subprocess.run([program, *map(str, words), '--json'], check=True, stdout=subprocess.PIPE,
                                     stderr=subprocess.DEVNULL).stdout)


def errors(folder, *words):
    table = answer('replay', folder, *words, '--out', folder / 'replayed')
    return [gap['rmse'] for run in table['runs'] for gap in run['gaps']]


with tempfile.TemporaryDirectory() as home:
    home = pathlib.Path(home)
    sound = other_engine.muscles_of([])
    other_engine.write_dataset(home / 'sound', sound, gauges=False)
    assert max(errors(home / 'sound')) < 1.15 * noise_rad, 'both engines simulate the same rig'

    leaking = other_engine.muscles_of([f'muscle_leak={leak}@2'])
    sizes = []
    for side, mirrored in (2, False), (1, True):
        data = home / f'leak{side}'
        other_engine.write_dataset(data, leaking, gauges=False, mirrored=mirrored)
        found = answer('diagnose', data, '--out', data / 'found')
        assert found['verdict'] == 'missing_effect', found['because']
        assert [(e['name'], e.get('side')) for e in found['effects']] == [('muscle_leak', side)], found['because']
        assert f'muscle_leak of muscle {side}' in found['because'], found['because']
        size = found['effects'][0]['parameters']['conductance']
        assert size['ci95'][0] < leak < size['ci95'][1], size
        sizes.append(size['value'])
        assert max(errors(data)) > 3 * noise_rad
        assert max(errors(data, '--rig', data / 'found' / 'rig.yaml')) < 1.15 * noise_rad
    # Muscle 2 is described by how it differs from muscle 1: priors are not mirrored to the last digit.
    assert abs(sizes[0] - sizes[1]) < 0.1 * (size['ci95'][1] - leak), sizes

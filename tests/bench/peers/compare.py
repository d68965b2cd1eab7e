#!/usr/bin/env python3
# The same dry wall in ERBS, and in peer codes installed from the distribution's packages (yade, libbullet-dev), as one table.
#   tests/bench/peers/compare.py [--erbs build/release/erbs] [--bricks 40] [--courses 25] [--peer-seconds 0.02]
# Every code runs on one thread, one after another. Result: processor seconds per simulated second at dt = 5e-5 s.
import argparse
import json
import os
import shutil
import subprocess
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
dt = 5e-5


def erbs(arguments, folder):
    out = os.path.join(folder, 'erbs.json')
    scene = os.path.join(here, '..', '..', '..', 'scenes', 'bench', 'dry_wall.lua')
    subprocess.run([arguments.erbs, 'bench', scene, '-D', f'bricks={arguments.bricks}', '-D', f'courses={arguments.courses}', '-o', out, '--force', '-q'],
                   check=True)
    row = json.load(open(out))[0]
    one = row['one_thread']
    return one['cpu_s_per_s'], row['points'], row['blocks'] - 1


def bullet(arguments, folder):
    if subprocess.run(['pkg-config', '--exists', 'bullet']).returncode != 0:
        return None
    flags = subprocess.run(['pkg-config', '--cflags', '--libs', 'bullet'], check=True, capture_output=True, text=True).stdout.split()
    program = os.path.join(folder, 'dry_wall_bullet')
    subprocess.run(['c++', '-O2', '-march=native', os.path.join(here, 'dry_wall_bullet.cpp'), '-o', program] + flags, check=True)
    seconds = max(arguments.peer_seconds, 100 * dt)
    out = subprocess.run([program, str(arguments.bricks), str(arguments.courses), str(dt), str(seconds)], check=True, capture_output=True, text=True)
    return [float(x) for x in out.stdout.split()]


def yade(arguments, folder):
    if shutil.which('yade') is None:
        return None
    steps = max(10, int(arguments.peer_seconds / dt) // 10)
    command = ['yade', '-n', '-x', '-j1', os.path.join(here, 'dry_wall_yade.py'), str(arguments.bricks), str(arguments.courses), str(dt), str(steps)]
    out = subprocess.run(command, check=True, capture_output=True, text=True, env={**os.environ, 'OMP_NUM_THREADS': '1'})
    return [float(x) for x in out.stdout.strip().splitlines()[-1].split()]


def main():
    parser = argparse.ArgumentParser(description='the same dry wall in several codes')
    parser.add_argument('--erbs', default=os.path.join(here, '..', '..', '..', 'build', 'release', 'erbs'))
    parser.add_argument('--bricks', type=int, default=40)
    parser.add_argument('--courses', type=int, default=25)
    parser.add_argument('--peer-seconds', type=float, default=0.02, help='simulated by each peer')
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        codes = [('ERBS', erbs, ''), ('Bullet', bullet, 'libbullet-dev'), ('Yade, polyhedra', yade, 'yade')]
        results = [(name, code(arguments, folder), package) for name, code, package in codes]
    ours = results[0][1][0]
    print(f'{"code":<18} {"CPU s per s":>12} {"over ERBS":>10} {"contacts":>9} {"bricks":>7}')
    for name, result, package in results:
        if result is None:
            print(f'{name:<18} not installed: apt-get install {package}')
        else:
            print(f'{name:<18} {result[0]:>12.4g} {result[0] / ours:>10.3g} {int(result[1]):>9} {int(result[2]):>7}')


main()

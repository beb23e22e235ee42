"""Runs programs and counts their CPU seconds."""
import json
import os
import subprocess
import sys
import tempfile

DEVICE_FAILED = 4  # exit code of meniscal: no such device, device lost, or more than it can hold


class Refused(Exception):
    """The device cannot hold the scene; the text is the program's own."""


def cpu_seconds(command, warm=False):
    """User and system seconds of the process and its children, started cold unless `warm`: drivers' caches of compiled shaders are off."""
    environment = {**os.environ, "MESA_SHADER_CACHE_DISABLE": "false" if warm else "true"}
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL, stdout=output, stderr=output)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            output.seek(0)
            said = output.read().decode(errors="replace")
            if process.returncode == DEVICE_FAILED:
                raise Refused(said.strip().splitlines()[-1])
            sys.stderr.write(said)
            raise SystemExit(f"benchmark: exit code {process.returncode} of: {' '.join(command)}")
    return usage.ru_utime + usage.ru_stime


def least_cpu_seconds(command, repeats, warm=False):
    """The least of several runs: other processes on the machine only ever add."""
    return min(cpu_seconds(command, warm) for _ in range(repeats))


class Meniscal:
    """The program, and what it can do."""

    def __init__(self, path):
        self.path = path
        self.help = subprocess.run([path, "render", "--help"], check=True, capture_output=True, text=True).stdout

    def has(self, option):
        return option in self.help

    def command(self, scene, output, *options):
        return [self.path, "render", scene, "--output", output, "--quiet", *map(str, options)]

    def render(self, scene, output, *options, repeats=1, warm=False):
        """CPU seconds, the least of several runs, and the statistics of the last."""
        statistics = output + ".json"
        seconds = least_cpu_seconds(self.command(scene, output, "--stats", statistics, *options), repeats, warm)
        with open(statistics, encoding="utf-8") as file:
            return seconds, json.load(file)

"""Runs programs and counts their CPU seconds."""
import os
import subprocess
import sys
import tempfile


def cpu_seconds(command, environment=None):
    """User and system seconds of the process and its children, started cold: drivers' caches of compiled shaders are off."""
    environment = {**os.environ, "MESA_SHADER_CACHE_DISABLE": "true", **(environment or {})}
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL, stdout=output, stderr=output)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            output.seek(0)
            sys.stderr.write(output.read().decode(errors="replace"))
            raise SystemExit(f"benchmark: exit code {process.returncode} of: {' '.join(command)}")
    return usage.ru_utime + usage.ru_stime


def least_cpu_seconds(command, repeats):
    """The least of several runs: other processes on the machine only ever add."""
    return min(cpu_seconds(command) for _ in range(repeats))


class Meniscal:
    """The program, and what it can do."""

    def __init__(self, path):
        self.path = path
        self.help = subprocess.run([path, "render", "--help"], check=True, capture_output=True, text=True).stdout

    def has(self, option):
        return option in self.help

    def command(self, scene, output, *options):
        return [self.path, "render", scene, "--output", output, "--quiet", *map(str, options)]

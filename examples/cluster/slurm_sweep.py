"""A sweep on a cluster with SLURM: python slurm_sweep.py CASE.toml STORE, on a machine that may submit jobs.

Every job is one machine of 16 cores with 16 workers. STORE is on a disk that all machines see. Called again, it goes on.
"""

import subprocess
import sys

from dask_jobqueue import SLURMCluster


def main(case: str, store: str) -> int:
    with SLURMCluster(
        queue="normal",  # partition of your cluster
        account=None,  # whom it is charged to
        cores=16,
        processes=16,  # one worker a core
        memory="32GB",
        walltime="04:00:00",
        job_script_prologue=["export OMP_NUM_THREADS=1"],
    ) as cluster:
        cluster.adapt(minimum_jobs=64, maximum_jobs=64)  # those whose time is up are submitted again
        return subprocess.call(["stiction", "sweep", case, "--out", store, "--scheduler", cluster.scheduler_address])


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

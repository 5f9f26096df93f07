#!/usr/bin/env python3
# One contact problem solved by Siconos:  siconos_solve.py PROBLEM.hdf5 ANSWERS.hdf5 SOLVER SECONDS
#
#   PROBLEM   FCLIB file in local form, W by compressed columns
#   ANSWERS   written: for each solve /answers/K with tolerance, seconds, iterations and r, K = 0, 1, ...
#   SOLVER    nsgs, nsn_ac or admm
#   SECONDS   processor time that one solve may take
#
# Siconos has no history, so the problem is solved anew for each tolerance from 1e-3 to 1e-12, until one takes too long.
# All other options are Siconos' defaults; W is stored in blocks, its quickest form. The clock is that of the processor and
# runs in the call of the driver only (one thread); the driver's own tests of the error are part of its time, short solves
# are repeated and their mean taken. Each tolerance has
# a process of its own, which the system ends when its time is over. Needs python3-siconos, python3-scipy, python3-h5py.
import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"
os.environ["OMP_NUM_THREADS"] = "1"

import pickle
import resource
import sys
import tempfile
import time
import warnings

import h5py
import numpy as np
import scipy.sparse
import siconos.numerics as sn

drivers = {
    (2, "nsgs"): ("SICONOS_FRICTION_2D_NSGS", "fc2d_driver"),
    (3, "nsgs"): ("SICONOS_FRICTION_3D_NSGS", "fc3d_driver"),
    (3, "nsn_ac"): ("SICONOS_FRICTION_3D_NSN_AC", "fc3d_driver"),
    (3, "admm"): ("SICONOS_FRICTION_3D_ADMM", "fc3d_driver"),
    (5, "nsgs"): ("SICONOS_ROLLING_FRICTION_3D_NSGS", "rolling_fc3d_driver"),
    (5, "admm"): ("SICONOS_ROLLING_FRICTION_3D_ADMM", "rolling_fc3d_driver"),
}
tolerances = [10.0**-k for k in range(3, 13)]


class Problem:
    def __init__(self, path):
        with h5py.File(path, "r") as file:
            form = file["fclib_local"]
            number = lambda name: int(np.ravel(form[name][()])[0])
            assert number("W/nz") == -1, "W is expected by compressed columns"
            rows = number("W/m")
            self.block = number("spacedim")
            self.w = scipy.sparse.csc_matrix((form["W/x"][:], form["W/i"][:], form["W/p"][:]), shape=(rows, rows))
            self.q, self.mu = form["vectors/q"][:], form["vectors/mu"][:]
            self.mu_r = form["vectors/mur"][:] if self.block == 5 else None

    def of_siconos(self):
        if self.block < 5:
            self.blocks = sn.SBM_from_csparse(self.block, self.w)[1]
            return sn.FrictionContactProblem(self.block, self.blocks, self.q, self.mu)
        # Rolling problems can't be made from arrays: they go through Siconos' text format (these are small).
        with tempfile.NamedTemporaryFile("w", suffix=".dat") as file:
            size = len(self.q)
            file.write(f"5\n{len(self.mu)}\n0\n{size}\n{size}\n{size}\t{size}\n")
            for values in (self.w.toarray(), self.q, self.mu, self.mu_r):
                file.write(" ".join("%.17g" % value for value in np.ravel(values)) + "\n")
            file.flush()
            return sn.rollingFrictionContact_new_from_filename(file.name)


def solve(problem, solver, tolerance):
    """Seconds, iterations, r, and whether Siconos says that it got there."""
    total, count = 0, 0
    while count == 0 or (total < 0.05 and count < 100):
        seconds, iterations, r, good = solve_once(problem, solver, tolerance)
        total, count = total + seconds, count + 1
    return total / count, iterations, r, good


def solve_once(problem, solver, tolerance):
    name, driver = drivers[problem.block, solver]
    given = problem.of_siconos()
    options = sn.SolverOptions(getattr(sn, name))
    options.dparam[sn.SICONOS_DPARAM_TOL] = tolerance
    options.iparam[sn.SICONOS_IPARAM_MAX_ITER] = 10**9 if solver == "nsgs" else 10**6
    if solver == "nsn_ac":
        options.iparam[sn.SICONOS_IPARAM_MAX_ITER] = 10**4
    r, u = np.zeros(len(problem.q)), np.zeros(len(problem.q))
    started = time.process_time()
    info = getattr(sn, driver)(given, r, u, options)
    seconds = time.process_time() - started
    return seconds, int(options.iparam[sn.SICONOS_IPARAM_ITER_DONE]), r, info == 0


def solve_apart(problem, solver, tolerance, limit):
    """solve() in a child that the system ends after `limit` seconds of processor time; None when it had to."""
    reads, writes = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reads)
        spent = int(time.process_time()) + 1
        resource.setrlimit(resource.RLIMIT_CPU, (spent + limit, spent + limit + 1))
        os.dup2(2, 1)  # what Siconos says belongs to no answer
        try:
            answer = solve(problem, solver, tolerance)
        except Exception as error:
            print("siconos_solve.py:", error, file=sys.stderr)
            answer = None
        with os.fdopen(writes, "wb") as pipe:
            pickle.dump(answer, pipe)
        os._exit(0)
    os.close(writes)
    with os.fdopen(reads, "rb") as pipe:
        text = pipe.read()
    os.waitpid(child, 0)
    answer = pickle.loads(text) if text else None
    return answer if answer is None or answer[0] <= limit else None


def main():
    path, answers, solver, seconds = sys.argv[1:]
    warnings.simplefilter("ignore")  # about integers of 32 bits
    problem = Problem(path)
    with h5py.File(answers, "w") as file:
        for number, tolerance in enumerate(tolerances):
            answer = solve_apart(problem, solver, tolerance, int(float(seconds) + 0.999))
            if answer is None:
                break
            group = file.create_group(f"answers/{number}")
            group["tolerance"], group["seconds"], group["iterations"] = [tolerance], [answer[0]], [answer[1]]
            group["r"] = answer[2]
            if not answer[3]:
                break


main()

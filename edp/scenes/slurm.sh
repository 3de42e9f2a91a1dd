#!/bin/sh
# slurm.sh: a batch script for a cluster with SLURM: sbatch edp/scenes/slurm.sh SCRIPT FLAGS..., from the package's folder
# A case on 16 ranks: sbatch -n 16 edp/scenes/slurm.sh edp/parts-3d.edp -mesh my.geo -case my.case -order 1. Tried without SLURM only.
# The package is on a file system that all nodes share, and so is TMPDIR for a case: one process makes the mesh, all read it.
# Each rank holds its part of the mesh and all of the surface: 0.05 GB for the program, and of n unknowns at most 2.6 kB n of P1, 4.5 of
# P2, divided by the ranks, and 18 kB n^(2/3) of P1, 28 of P2.
#SBATCH --job-name=contact
#SBATCH --nodes=2
#SBATCH --ntasks-per-node=8
#SBATCH --mem=16G
#SBATCH --time=02:00:00
set -e
: "${SLURM_NTASKS:?: start this by sbatch, or set it to the number of processes}"
export OPENBLAS_NUM_THREADS=1
test $# -gt 0 || set -- edp/scenes/sphere-on-block.edp -h 0.05 -order 1
make mpi
# the mesh first, by one process: the others would wait for gmsh
said=$(sh edp/freefem.sh "$@" -solver none) || { code=$?; echo "$said"; exit "$code"; }
echo "$said" | awk -v ranks="$SLURM_NTASKS" '{ print }
    match($0, /[0-9]+ unknowns of P[12]/) { split(substr($0, RSTART), word, " "); n = word[1]; first = word[4] == "P1"
        own = n * (first ? 2.6e-6 : 4.5e-6) / ranks; surface = n ^ (2 / 3) * (first ? 18e-6 : 28e-6)
        printf "memory: up to %.2g GB on each of %d processes\n", 0.05 + own + surface, ranks }'
mpiexec -n "$SLURM_NTASKS" sh edp/freefem.sh "$@" -solver multigrid

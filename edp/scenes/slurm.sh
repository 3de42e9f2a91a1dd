#!/bin/sh
# slurm.sh: a batch script for a cluster with SLURM, as an example: not tried. From the repository's root: sbatch edp/scenes/slurm.sh
# The repository is on a file system that all nodes share, and so is TMPDIR for a case file: one process makes the mesh, all read it.
# Each rank holds its part of the mesh: 0.05 GB for the program, and at most 3.7 kB an unknown of P1, 6.3 of P2, divided by the ranks.
#SBATCH --job-name=contact
#SBATCH --nodes=2
#SBATCH --ntasks-per-node=8
#SBATCH --mem=64G
#SBATCH --time=02:00:00
set -e
export OPENBLAS_NUM_THREADS=1
run="edp/scenes/sphere-on-block.edp -h 0.05 -order 1"
make mpi
# the mesh first, by one process: the others would wait for gmsh; it says the memory that the rest takes
FreeFem++ -nw -v 0 $run -solver none
mpiexec -n "$SLURM_NTASKS" FreeFem++-mpi -nw -v 0 $run -solver multigrid -out results/slurm

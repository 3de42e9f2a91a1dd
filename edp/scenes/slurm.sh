#!/bin/sh
# slurm.sh: a batch script for a cluster with SLURM, as an example: not tried. From the repository's root: sbatch edp/scenes/slurm.sh
# Each rank reads the whole mesh: 0.3 kB an unknown or so on every rank (P1; P2 less), so few ranks a node for a large mesh.
#SBATCH --job-name=contact
#SBATCH --nodes=2
#SBATCH --ntasks-per-node=8
#SBATCH --mem=64G
#SBATCH --time=02:00:00
export OPENBLAS_NUM_THREADS=1
# the mesh first, by one process: the others would wait for gmsh
FreeFem++ -nw -v 0 edp/scenes/sphere-on-block.edp -h 0.05 -order 1 -maxNewton 1 -solver multigrid -vtu 0 -out results/mesh-only
mpiexec -n "$SLURM_NTASKS" FreeFem++-mpi -nw -v 0 edp/scenes/sphere-on-block.edp -h 0.05 -order 1 -solver multigrid -out results/slurm

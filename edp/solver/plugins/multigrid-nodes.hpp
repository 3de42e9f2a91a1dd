// multigrid-nodes.hpp: the ranks of a run, and the nodes of a mesh cut into as many boxes as there are ranks
// A rank owns the nodes of its box and assembles every element that touches one of them, so that its rows are complete and no entry is
// sent. PETSc numbers the nodes rank after rank. Included by multigrid-cut.hpp alone.
// failed(), CHECK(call): a failure of PETSc ends the run; ranksNow, rankNow, meetRanks, firstRankSays: FreeFEM's functions of that name;
// startPetsc(); keepMemory(); placeNodes(V, at): coordinates (3 x nodes); cutNodes(nodes): ownerOf, numberOf of a whole mesh.
#include "ff++.hpp"
#include "AFunction_ext.hpp"
#include <petsc.h>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <limits>
#include <malloc.h>
#include <new>
#include <numeric>
#include <unistd.h>
#include <vector>

#define CHECK(call) do { PetscErrorCode code = (call); if (code) failed(code, #call); } while (0)

namespace
{
const int components = 3;

// nodes by FreeFEM's number: the rank that owns it, PETSc's number
std::vector<int> ownerOf, numberOf;
PetscInt ownNodes = 0, firstNode = 0;
std::vector<double> place;                 // coordinates of all nodes, until the matrix is made

// ---------------------------------------------------------------- failures

void noMemory()
// As outOfMemory() of solver/compliance/memory.idp says it, on any rank: it ends the run.
{
    std::cout << "out of memory: multigrid: raise -h, or use a machine that has more" << std::endl;
    int on = 0;
    MPI_Initialized(&on);
    int ranks = 1;
    if (on) MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    if (ranks > 1) MPI_Abort(MPI_COMM_WORLD, 30);
    _exit(30);
}

void failed(PetscErrorCode code, const char * call)
{
    if (code == PETSC_ERR_MEM) noMemory();
    const char * why = nullptr;
    PetscErrorMessage(code, &why, nullptr);
    std::cout << "PETSc: " << (why ? why : "error") << std::endl;
    ExecError(call);
}

// ---------------------------------------------------------------- ranks

bool mpiRuns()
// In FreeFem++-mpi; FreeFem++ is one process, which input/ranks.idp sees to.
{
    int on = 0;
    MPI_Initialized(&on);
    return on;
}

long ranksNow()
{
    int count = 1;
    if (mpiRuns()) MPI_Comm_size(MPI_COMM_WORLD, &count);
    return count;
}

long rankNow()
{
    int mine = 0;
    if (mpiRuns()) MPI_Comm_rank(MPI_COMM_WORLD, &mine);
    return mine;
}

long meetRanks()
// Returns when every rank is here.
{
    if (mpiRuns()) MPI_Barrier(MPI_COMM_WORLD);
    return 0;
}

long firstRankSays(const long & value)
{
    long said = value;
    if (mpiRuns()) MPI_Bcast(&said, 1, MPI_LONG, 0, MPI_COMM_WORLD);
    return said;
}

void startPetsc()
{
    PetscBool on = PETSC_FALSE;
    PetscInitialized(&on);
    if (on) return;
    CHECK(PetscOptionsSetValue(nullptr, "-no_signal_handler", "true"));
    CHECK(PetscInitializeNoArguments());
    CHECK(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
    std::set_new_handler(noMemory);
}

// ---------------------------------------------------------------- the parts

int nodesOfElement(const FESpace3 & V)
{
    return V[0].NbDoF() / components;
}

int nodeOf(const FESpace3 & V, int k, int j)
{
    return V[k](j) / components;
}

void placeNodes(const FESpace3 & V, std::vector<double> & at)
// Corners of the elements and, of P2, the middles of their edges.
{
    at.assign(V.NbOfDF, 0.);
    int each = nodesOfElement(V);
    for (int k = 0; k < V.Th.nt; k++)
        for (int j = 0; j < each; j++)
        {
            const Tet & T = V.Th[k];
            const R3 & a = T[j < 4 ? j : Tet::nvedge[j - 4][0]];
            const R3 & b = T[j < 4 ? j : Tet::nvedge[j - 4][1]];
            double * to = &at[components * nodeOf(V, k, j)];
            to[0] = 0.5 * (a.x + b.x);
            to[1] = 0.5 * (a.y + b.y);
            to[2] = 0.5 * (a.z + b.z);
        }
}

void cut(std::vector<int>::iterator from, std::vector<int>::iterator to, int firstPart, int parts)
// Nodes from ... to go to so many parts of equal size, across their longest side first. Ties go by number: the same on all ranks.
{
    if (parts == 1)
    {
        for (auto n = from; n != to; ++n) ownerOf[*n] = firstPart;
        return;
    }
    double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
    for (auto n = from; n != to; ++n)
        for (int c = 0; c < 3; c++)
        {
            low[c] = std::min(low[c], place[3 * *n + c]);
            high[c] = std::max(high[c], place[3 * *n + c]);
        }
    int side = 0;
    for (int c = 1; c < 3; c++) if (high[c] - low[c] > (1 + 1e-9) * (high[side] - low[side])) side = c;
    auto middle = from + (to - from) * (parts / 2) / parts;
    std::nth_element(from, middle, to, [side](int a, int b)
    {
        double at = place[3 * a + side], bt = place[3 * b + side];
        return at < bt || (at == bt && a < b);
    });
    cut(from, middle, firstPart, parts / 2);
    cut(middle, to, firstPart + parts / 2, parts - parts / 2);
}

void forget();                             // what there is of another mesh: multigrid-matrix.hpp

void keepMemory()
// FreeFEM forbids the C library to give memory back: matrices come and go here.
{
    mallopt(M_MMAP_MAX, 1 << 16);
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 24);
}

void cutNodes(int nodes)
// The nodes of a whole mesh, by `place`: ownerOf, numberOf.
{
    int ranks = ranksNow(), rank = rankNow();
    ownerOf.assign(nodes, 0);
    std::vector<int> order(nodes);
    std::iota(order.begin(), order.end(), 0);
    cut(order.begin(), order.end(), 0, ranks);
    std::vector<int> next(ranks + 1, 0);
    for (int n = 0; n < nodes; n++) next[ownerOf[n] + 1]++;
    ownNodes = next[rank + 1];
    for (int r = 0; r < ranks; r++) next[r + 1] += next[r];
    firstNode = next[rank];
    numberOf.resize(nodes);
    for (int n = 0; n < nodes; n++) numberOf[n] = next[ownerOf[n]]++;
}
}

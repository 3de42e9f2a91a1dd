// multigrid.cpp: a FreeFEM plugin on PETSc: the stiffness of bodies in space, spread over the ranks, solved by multigrid
// Built by `make mpi`; operator/multigrid.idp is its only user. Needs PETSc 3.14 or newer; runs in FreeFem++ and FreeFem++-mpi.
// Every rank reads the whole mesh. The nodes are cut into as many boxes as there are ranks; a rank assembles the elements that
// touch a node of its own, so its rows are complete and no matrix entry is sent. PETSc numbers the nodes rank after rank.
// Held dofs are taken out of the matrix: their rows and columns are 0 but for the diagonal. The rows' entries are kept apart,
// for the forces of the supports.
#include "ff++.hpp"
#include "AFunction_ext.hpp"
#include <petsc.h>
#include <algorithm>
#include <cstdlib>
#include <new>
#include <numeric>
#include <unistd.h>
#include <vector>

#define CHECK(call) do { PetscErrorCode code = (call); if (code) failed(code, #call); } while (0)

namespace
{
const int components = 3;
const int modes = 6;                       // translations and rotations

// nodes by FreeFEM's number: the rank that owns it, PETSc's number
std::vector<int> ownerOf, numberOf;
PetscInt ownNodes = 0, firstNode = 0;
std::vector<int> elementNode;              // of the rank's elements, by the whole mesh's number: their nodes, -1 else
std::vector<int> partNode;                 // of the part's nodes: their number in the whole mesh
std::vector<double> place;                 // coordinates of all nodes, until the matrix is made

Mat K = nullptr;
KSP solver = nullptr;
Vec load = nullptr, last = nullptr, carried = nullptr, work = nullptr;
VecScatter toWatched = nullptr;
Vec watchedValues = nullptr;
std::vector<int> watched;                  // dofs by FreeFEM's number
struct HeldEntry { int row, column; double value; };     // PETSc's numbers of dofs
std::vector<HeldEntry> heldEntries;
std::vector<PetscInt> heldRows;            // of this rank, from 0

// ---------------------------------------------------------------- failures

void noMemory()
// As outOfMemory() of operator/memory.idp says it, on any rank: it ends the run.
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
// In FreeFem++-mpi; FreeFem++ is one process, which case/ranks.idp sees to.
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

long multigridParts(pfes3 * const & space, KN<double> * const & own)
// own: 1 at the elements of this rank, 0 at the others; returns how many they are.
{
    startPetsc();
    FESpace3 & V = *(FESpace3 *) **space;
    int ranks = ranksNow(), rank = rankNow(), nodes = V.NbOfDF / components, each = nodesOfElement(V);
    placeNodes(V, place);
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
    long count = 0;
    elementNode.assign((size_t) V.Th.nt * each, -1);
    for (int k = 0; k < V.Th.nt; k++)
    {
        bool mine = false;
        for (int j = 0; j < each; j++) mine = mine || ownerOf[nodeOf(V, k, j)] == rank;
        (*own)[k] = mine;
        count += mine;
        for (int j = 0; j < each && mine; j++) elementNode[(size_t) k * each + j] = nodeOf(V, k, j);
    }
    return count;
}

// ---------------------------------------------------------------- the matrix

void wholeNumbers(const FESpace3 & V, const KN<long> & old, std::vector<int> & node)
// FreeFEM's number in the whole mesh of each node of the part; old: the elements' numbers there.
{
    int each = nodesOfElement(V);
    std::vector<double> at;
    placeNodes(V, at);
    node.assign(V.NbOfDF / components, -1);
    for (int k = 0; k < V.Th.nt; k++)
        for (int j = 0; j < each; j++)
        {
            int n = nodeOf(V, k, j), whole = elementNode[(size_t) (old.N() ? old[k] : k) * each + j];
            for (int c = 0; c < 3; c++)
                if (whole < 0 || at[3 * n + c] != place[3 * whole + c])
                    ExecError("multigrid: a part's element is not the whole's");
            node[n] = whole;
        }
}

void rowsOf(const HashMatrix<int, double> & A, const std::vector<int> & node, const KN<double> & released,
            std::vector<PetscInt> & start, std::vector<PetscInt> & column, std::vector<PetscScalar> & value)
// The rank's rows, columns in order, out of the elements' matrix, all or half of it stored; held dofs' are put aside.
{
    PetscInt first = components * firstNode, rows = components * ownNodes;
    auto number = [&](int i) { return components * numberOf[node[i / components]] + i % components; };
    auto freed = [&](int i) { return released[components * node[i / components] + i % components] != 0; };
    start.assign(rows + 1, 0);
    for (int pass = 0; pass < 2; pass++)
    {
        for (size_t k = 0; k < A.nnz; k++)
            for (int turned = 0; turned < (A.half && A.i[k] != A.j[k] ? 2 : 1); turned++)
            {
                int i = turned ? A.j[k] : A.i[k], j = turned ? A.i[k] : A.j[k];
                PetscInt row = number(i) - first;
                if (row < 0 || row >= rows) continue;
                if (!freed(i) && pass == 0) heldEntries.push_back({(int) (row + first), (int) number(j), A.aij[k]});
                if (i != j && !(freed(i) && freed(j))) continue;
                if (pass == 0) start[row + 1]++;
                else
                {
                    column[start[row]] = number(j);
                    value[start[row]++] = A.aij[k];
                }
            }
        if (pass == 0)
        {
            std::partial_sum(start.begin(), start.end(), start.begin());
            column.resize(start[rows]);
            value.resize(start[rows]);
        }
    }
    for (PetscInt r = rows; r > 0; r--) start[r] = start[r - 1];
    start[0] = 0;
    std::vector<std::pair<PetscInt, PetscScalar>> entries;
    for (PetscInt r = 0; r < rows; r++)
    {
        entries.clear();
        for (PetscInt k = start[r]; k < start[r + 1]; k++) entries.emplace_back(column[k], value[k]);
        std::sort(entries.begin(), entries.end());
        for (PetscInt k = start[r]; k < start[r + 1]; k++) std::tie(column[k], value[k]) = entries[k - start[r]];
    }
}

void setRigidBodies(const KN<double> & released)
// What the coarse levels must carry: rigid motions. Taking out the held dofs gains nothing.
{
    Vec motion[modes];
    double * value[modes];
    for (int m = 0; m < modes; m++)
    {
        CHECK(VecDuplicate(load, &motion[m]));
        CHECK(VecGetArray(motion[m], &value[m]));
    }
    for (int n = 0; n < (int) numberOf.size(); n++)
    {
        PetscInt at = numberOf[n] - firstNode;
        if (at < 0 || at >= ownNodes) continue;
        const double * p = &place[3 * n];
        for (int c = 0; c < 3; c++)
        {
            bool moves = released[3 * n + c] != 0;
            if (!moves) heldRows.push_back(3 * at + c);
            for (int m = 0; m < 3; m++) value[m][3 * at + c] = c == m;
            // about axis m: e_m x p
            for (int m = 0; m < 3; m++)
                value[3 + m][3 * at + c] = c == m ? 0. : (c == (m + 1) % 3 ? -p[(m + 2) % 3] : p[(m + 1) % 3]);
        }
    }
    for (int m = 0; m < modes; m++)
    {
        CHECK(VecRestoreArray(motion[m], &value[m]));
        for (int l = 0; l < m; l++)
        {
            PetscScalar share;
            CHECK(VecDot(motion[m], motion[l], &share));
            CHECK(VecAXPY(motion[m], -share, motion[l]));
        }
        CHECK(VecNormalize(motion[m], nullptr));
    }
    MatNullSpace rigid;
    CHECK(MatNullSpaceCreate(PETSC_COMM_WORLD, PETSC_FALSE, modes, motion, &rigid));
    CHECK(MatSetNearNullSpace(K, rigid));
    CHECK(MatNullSpaceDestroy(&rigid));
    for (int m = 0; m < modes; m++) CHECK(VecDestroy(&motion[m]));
}

long multigridMatrix(Matrice_Creuse<double> * const & matrix, pfes3 * const & space, KN<long> * const & old,
                     KN<double> * const & released)
// The part's matrix goes to PETSc, and is emptied. old: the part's elements in the whole mesh, empty if the part is the whole.
{
    HashMatrix<int, double> & A = *matrix->pHM();
    FESpace3 & V = *(FESpace3 *) **space;
    wholeNumbers(V, *old, partNode);
    std::vector<int>().swap(elementNode);
    {
        std::vector<PetscInt> start, column;
        std::vector<PetscScalar> value;
        rowsOf(A, partNode, *released, start, column, value);
        A.resize(0, 0, 0);
        PetscInt rows = components * ownNodes;
        CHECK(MatCreate(PETSC_COMM_WORLD, &K));
        CHECK(MatSetSizes(K, rows, rows, PETSC_DETERMINE, PETSC_DETERMINE));
        CHECK(MatSetBlockSize(K, components));
        CHECK(MatSetType(K, MATAIJ));
        CHECK(MatSeqAIJSetPreallocationCSR(K, start.data(), column.data(), value.data()));
        CHECK(MatMPIAIJSetPreallocationCSR(K, start.data(), column.data(), value.data()));
    }
    CHECK(MatSetOption(K, MAT_SPD, PETSC_TRUE));
    CHECK(MatCreateVecs(K, &last, &load));
    CHECK(VecDuplicate(last, &carried));
    CHECK(VecDuplicate(last, &work));
    CHECK(VecSet(carried, 0));
    CHECK(VecSet(last, 0));
    setRigidBodies(*released);
    std::vector<double>().swap(place);
    std::vector<int>().swap(ownerOf);
    return components * ownNodes;
}

long multigridSetUp(string * const & options)
// The levels. options: PETSc's, those of the environment variable PETSC_OPTIONS count more.
{
    CHECK(PetscOptionsInsertString(nullptr, options->c_str()));
    const char * own = getenv("PETSC_OPTIONS");
    if (own) CHECK(PetscOptionsInsertString(nullptr, own));
    CHECK(KSPCreate(PETSC_COMM_WORLD, &solver));
    CHECK(KSPSetOperators(solver, K, K));
    CHECK(KSPSetType(solver, KSPCG));
    PC levels;
    CHECK(KSPGetPC(solver, &levels));
    CHECK(PCSetType(levels, PCGAMG));
    CHECK(KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED));
    CHECK(KSPSetFromOptions(solver));
    CHECK(KSPSetUp(solver));
    return 0;
}

// ---------------------------------------------------------------- solves

PetscInt numberOfDof(int dof)
{
    return components * numberOf[dof / components] + dof % components;
}

void spread(const KN_<double> & from, Vec to)
// A field at FreeFEM's dofs, the same on every rank, into PETSc's vector; 0 at held dofs.
{
    double * value;
    CHECK(VecGetArray(to, &value));
    for (int n = 0; n < (int) numberOf.size(); n++)
    {
        PetscInt at = numberOf[n] - firstNode;
        if (at >= 0 && at < ownNodes)
            for (int c = 0; c < components; c++) value[components * at + c] = from[components * n + c];
    }
    for (PetscInt row : heldRows) value[row] = 0;
    CHECK(VecRestoreArray(to, &value));
}

Vec gathered(Vec from)
// All of it, on every rank; the caller's to destroy.
{
    VecScatter all;
    Vec here;
    CHECK(VecScatterCreateToAll(from, &all, &here));
    CHECK(VecScatterBegin(all, from, here, INSERT_VALUES, SCATTER_FORWARD));
    CHECK(VecScatterEnd(all, from, here, INSERT_VALUES, SCATTER_FORWARD));
    CHECK(VecScatterDestroy(&all));
    return here;
}

void collect(Vec from, KN_<double> to)
// The same back, on every rank.
{
    Vec here = gathered(from);
    const double * value;
    CHECK(VecGetArrayRead(here, &value));
    for (int n = 0; n < (int) numberOf.size(); n++)
        for (int c = 0; c < components; c++) to[components * n + c] = value[components * numberOf[n] + c];
    CHECK(VecRestoreArrayRead(here, &value));
    CHECK(VecDestroy(&here));
}

long multigridWhole(KN<double> * const & part, KN<double> * const & whole)
// Nodal forces of the part, complete at the rank's own nodes: those of the whole, on every rank.
{
    double * value;
    CHECK(VecGetArray(work, &value));
    for (int n = 0; n < (int) partNode.size(); n++)
    {
        PetscInt at = numberOf[partNode[n]] - firstNode;
        if (at >= 0 && at < ownNodes)
            for (int c = 0; c < components; c++) value[components * at + c] = (*part)[components * n + c];
    }
    CHECK(VecRestoreArray(work, &value));
    collect(work, *whole);
    return 0;
}

long multigridWatch(KN<long> * const & dofs)
// The dofs whose displacements every rank is told of after a solve.
{
    watched.assign(dofs->N(), 0);
    std::vector<PetscInt> number(dofs->N());
    for (long i = 0; i < dofs->N(); i++) watched[i] = (*dofs)[i];
    for (long i = 0; i < dofs->N(); i++) number[i] = numberOfDof(watched[i]);
    CHECK(VecScatterDestroy(&toWatched));
    CHECK(VecDestroy(&watchedValues));
    IS these;
    CHECK(ISCreateGeneral(PETSC_COMM_SELF, number.size(), number.data(), PETSC_COPY_VALUES, &these));
    CHECK(VecCreateSeq(PETSC_COMM_SELF, number.size(), &watchedValues));
    CHECK(VecScatterCreate(last, these, watchedValues, nullptr, &toWatched));
    CHECK(ISDestroy(&these));
    return 0;
}

long multigridSolve(KN<double> * const & forces, const double & tolerance, const bool & go)
// K u = forces, |residual| <= tolerance |forces|; go: from the displacement that is carried along, which the solution replaces.
// Forces on held dofs are left out. Returns the iterations, -1 without convergence.
{
    spread(*forces, load);
    CHECK(KSPSetTolerances(solver, tolerance, 1e-300, 1e10, 2000));
    CHECK(KSPSetInitialGuessNonzero(solver, go ? PETSC_TRUE : PETSC_FALSE));
    CHECK(KSPSolve(solver, load, go ? carried : last));
    KSPConvergedReason why;
    PetscInt count;
    CHECK(KSPGetConvergedReason(solver, &why));
    CHECK(KSPGetIterationNumber(solver, &count));
    return why > 0 ? count : -1;
}

long multigridWatched(KN<double> * const & field, const bool & ofCarried)
// The displacement at the watched dofs, the others of the field are left as they are.
{
    Vec from = ofCarried ? carried : last;
    CHECK(VecScatterBegin(toWatched, from, watchedValues, INSERT_VALUES, SCATTER_FORWARD));
    CHECK(VecScatterEnd(toWatched, from, watchedValues, INSERT_VALUES, SCATTER_FORWARD));
    const double * value;
    CHECK(VecGetArrayRead(watchedValues, &value));
    for (int i = 0; i < (int) watched.size(); i++) (*field)[watched[i]] = value[i];
    CHECK(VecRestoreArrayRead(watchedValues, &value));
    return 0;
}

long multigridField(KN<double> * const & field, const bool & ofCarried)
{
    collect(ofCarried ? carried : last, *field);
    return 0;
}

long multigridCarry(const double & share)
// carried += share * last; share 0: carried = 0.
{
    if (share == 0) CHECK(VecSet(carried, 0));
    else CHECK(VecAXPY(carried, share, last));
    return 0;
}

long multigridForces(KN<double> * const & field, KN<double> * const & forces)
// K u with the rows of held dofs: the forces on the supports; u is 0 there.
{
    spread(*field, work);
    CHECK(MatMult(K, work, load));
    Vec here = gathered(work);
    const double * u;
    double * f;
    CHECK(VecGetArrayRead(here, &u));
    CHECK(VecGetArray(load, &f));
    for (const HeldEntry & e : heldEntries) f[e.row - components * firstNode] += e.value * u[e.column];
    CHECK(VecRestoreArrayRead(here, &u));
    CHECK(VecRestoreArray(load, &f));
    CHECK(VecDestroy(&here));
    collect(load, *forces);
    return 0;
}

void start()
{
    Global.Add("ranksNow", "(", new OneOperator0<long>(ranksNow));
    Global.Add("rankNow", "(", new OneOperator0<long>(rankNow));
    Global.Add("meetRanks", "(", new OneOperator0<long>(meetRanks));
    Global.Add("firstRankSays", "(", new OneOperator1_<long, long>(firstRankSays));
    Global.Add("multigridParts", "(", new OneOperator2_<long, pfes3 *, KN<double> *>(multigridParts));
    Global.Add("multigridMatrix", "(",
               new OneOperator4_<long, Matrice_Creuse<double> *, pfes3 *, KN<long> *, KN<double> *>(multigridMatrix));
    Global.Add("multigridWhole", "(", new OneOperator2_<long, KN<double> *, KN<double> *>(multigridWhole));
    Global.Add("multigridSetUp", "(", new OneOperator1_<long, string *>(multigridSetUp));
    Global.Add("multigridWatch", "(", new OneOperator1_<long, KN<long> *>(multigridWatch));
    Global.Add("multigridSolve", "(", new OneOperator3_<long, KN<double> *, double, bool>(multigridSolve));
    Global.Add("multigridWatched", "(", new OneOperator2_<long, KN<double> *, bool>(multigridWatched));
    Global.Add("multigridField", "(", new OneOperator2_<long, KN<double> *, bool>(multigridField));
    Global.Add("multigridCarry", "(", new OneOperator1_<long, double>(multigridCarry));
    Global.Add("multigridForces", "(", new OneOperator2_<long, KN<double> *, KN<double> *>(multigridForces));
}
}
LOADFUNC(start)

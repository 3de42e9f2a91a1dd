// multigrid.cpp: a FreeFEM plugin on PETSc: the stiffness of bodies in space, spread over the ranks, solved by multigrid
// Built by `make mpi`; operator/multigrid.idp is its only user. Needs PETSc 3.14 or newer; runs in FreeFem++ and FreeFem++-mpi.
// Another list of functions at the end, or another meaning: raise the number in the names of operator/without/ and their includes.
// Every rank reads the whole mesh. The nodes are cut into as many boxes as there are ranks; a rank assembles the elements that
// touch a node of its own, so its rows are complete and no entry is sent. PETSc numbers the nodes rank after rank.
// A held node has a projector P onto what it is free to do: the matrix is P K P, and a stiffness of its own along what is held, so
// that directions which are no axes need no dofs of their own. K's entries at held nodes are kept apart: for the forces of the
// supports, and for the load of supports that are moved: a load along what is held, a huge stiffness times the way, as the direct
// engine has it. Bodies that nothing holds are grounded at dofs that are held; their rigid motions are taken from loads and
// displacements.
#include "ff++.hpp"
#include "AFunction_ext.hpp"
#include <petsc.h>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <malloc.h>
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
std::vector<double> place;                 // coordinates of all nodes, until the matrix is made

Mat K = nullptr;
KSP solver = nullptr;
Vec load = nullptr, last = nullptr, carried = nullptr, work = nullptr;
VecScatter toWatched = nullptr;
Vec watchedValues = nullptr;
std::vector<int> watched;                  // dofs by FreeFEM's number
struct ApartEntry { int row, column; double value; };    // the rank's row, from 0; FreeFEM's number of the dof
std::vector<ApartEntry> apart;             // K at nodes that are held, or beside one
typedef std::array<double, 9> Projector;
std::vector<int> holdOf;                   // of each node: its place in `loose`, -1: it is free
std::vector<Projector> loose;              // onto what a held node is free to do
std::vector<char> heldDof;                 // by FreeFEM's number; of a turned node along its own directions
std::vector<int> ownHeld;                  // the held nodes of this rank
double heldStiffness = 0;                  // a load over it is how far a held dof is moved
std::vector<Vec> rigidMotions;             // what nothing holds, orthonormal

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

void forget()
// What there is of another mesh.
{
    CHECK(KSPDestroy(&solver));
    CHECK(MatDestroy(&K));
    CHECK(VecScatterDestroy(&toWatched));
    for (Vec * v : {&load, &last, &carried, &work, &watchedValues}) CHECK(VecDestroy(v));
    for (Vec & motion : rigidMotions) CHECK(VecDestroy(&motion));
    rigidMotions.clear();
}

long multigridParts(pfes3 * const & space, KN<double> * const & own)
// own: 1 at the elements of this rank, 0 at the others; returns how many they are.
{
    startPetsc();
    forget();
    mallopt(M_MMAP_MAX, 1 << 16);          // FreeFEM forbids it, and to give anything back: matrices come and go here
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 24);
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
    for (int k = 0; k < V.Th.nt; k++)
    {
        bool mine = false;
        for (int j = 0; j < each; j++) mine = mine || ownerOf[nodeOf(V, k, j)] == rank;
        (*own)[k] = mine;
        count += mine;
    }
    return count;
}

// ---------------------------------------------------------------- the matrix

long multigridHold(KN<double> * const & released, Matrice_Creuse<double> * const & turning)
// released: 0 at held dofs; turning: their directions where they are no axes, a column each: the identity elsewhere, empty if all are.
{
    int nodes = released->N() / components;
    std::vector<Projector> frame(1, Projector{1, 0, 0, 0, 1, 0, 0, 0, 1});
    std::vector<int> frameOf(nodes, 0);
    HashMatrix<int, double> * T = turning->pHM();
    for (size_t k = 0; T && k < T->nnz; k++)
    {
        int i = T->i[k], j = T->j[k], n = i / components;
        if (i == j && T->aij[k] == 1) continue;
        if (frameOf[n] == 0)
        {
            frameOf[n] = frame.size();
            frame.push_back(Projector{});
        }
        frame[frameOf[n]][3 * (i % components) + j % components] = T->aij[k];
    }
    // a column of a turned node may be an axis
    for (size_t k = 0; T && k < T->nnz; k++)
        if (T->i[k] == T->j[k] && frameOf[T->i[k] / components])
            frame[frameOf[T->i[k] / components]][4 * (T->i[k] % components)] = T->aij[k];
    holdOf.assign(nodes, -1);
    loose.clear();
    heldDof.assign(released->N(), 0);
    for (int n = 0; n < nodes; n++)
    {
        const Projector & t = frame[frameOf[n]];
        Projector P{};
        bool held = false;
        for (int b = 0; b < components; b++)
        {
            bool moves = (*released)[components * n + b] != 0;
            held = held || !moves;
            heldDof[components * n + b] = !moves;
            for (int c = 0; c < 9 && moves; c++) P[c] += t[3 * (c / 3) + b] * t[3 * (c % 3) + b];
        }
        if (!held) continue;
        holdOf[n] = loose.size();
        loose.push_back(P);
    }
    return loose.size();
}

struct Entry { int row, column; double value; };         // FreeFEM's numbers of dofs

template <class Each> void entriesOf(const HashMatrix<int, double> & A, Each each)
// All entries of a matrix, of which half may be stored.
{
    for (size_t k = 0; k < A.nnz; k++)
    {
        each(Entry{A.i[k], A.j[k], A.aij[k]});
        if (A.half && A.i[k] != A.j[k]) each(Entry{A.j[k], A.i[k], A.aij[k]});
    }
}

template <class Each> void heldTo(const Entry & e, Each each)
// What an entry adds to P K P and along what is held: its own diagonal, of a turned node what fills the diagonal by a mean.
{
    int n = e.row / components, m = e.column / components, a = e.row % components, b = e.column % components;
    const Projector * P = holdOf[n] < 0 ? nullptr : &loose[holdOf[n]], * Q = holdOf[m] < 0 ? nullptr : &loose[holdOf[m]];
    for (int c = P ? 0 : a; c <= (P ? components - 1 : a); c++)
        for (int d = Q ? 0 : b; d <= (Q ? components - 1 : b); d++)
        {
            double share = (P ? (*P)[3 * c + a] : 1.) * (Q ? (*Q)[3 * b + d] : 1.);
            if (share != 0) each(Entry{components * n + c, components * m + d, share * e.value});
        }
    if (e.row != e.column || !P) return;
    bool axes = true;
    for (int c = 0; c < 9; c++) axes = axes && ((*P)[c] == 0 || (c % 4 == 0 && (*P)[c] == 1));
    for (int c = 0; c < 9; c++)
    {
        double share = (c % 4 == 0) - (*P)[c];
        if (share != 0 && (!axes || c == 4 * a))
            each(Entry{components * n + c / 3, components * n + c % 3, share * e.value / (axes ? 1 : components)});
    }
}

void rowsOf(const std::vector<const HashMatrix<int, double> *> & parts,
            std::vector<PetscInt> & start, std::vector<PetscInt> & column, std::vector<PetscScalar> & value)
// The rank's rows, columns in order, out of the matrices' sum; those at held nodes are put aside too.
{
    PetscInt first = components * firstNode, rows = components * ownNodes;
    auto number = [&](int i) { return components * numberOf[i / components] + i % components; };
    auto own = [&](int i) { PetscInt r = number(i) - first; return r >= 0 && r < rows; };
    start.assign(rows + 1, 0);
    for (int pass = 0; pass < 2; pass++)
    {
        for (auto part : parts)
            entriesOf(*part, [&](const Entry & e)
            {
                if (!own(e.row)) return;
                if (pass == 0 && (holdOf[e.row / components] >= 0 || holdOf[e.column / components] >= 0))
                    apart.push_back({(int) (number(e.row) - first), e.column, e.value});
                heldTo(e, [&](const Entry & h)
                {
                    PetscInt row = number(h.row) - first;
                    if (pass == 0) start[row + 1]++;
                    else
                    {
                        column[start[row]] = number(h.column);
                        value[start[row]++] = h.value;
                    }
                });
            });
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
    PetscInt used = 0;
    for (PetscInt r = 0; r < rows; r++)
    {
        entries.clear();
        for (PetscInt k = start[r]; k < start[r + 1]; k++) entries.emplace_back(column[k], value[k]);
        std::sort(entries.begin(), entries.end());
        start[r] = used;
        for (size_t k = 0; k < entries.size(); k++)
        {
            if (k > 0 && entries[k].first == entries[k - 1].first) value[used - 1] += entries[k].second;
            else std::tie(column[used], value[used]) = entries[k], used++;
        }
    }
    start[rows] = used;
    column.resize(used);
    value.resize(used);
}

void setRigidBodies()
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

long multigridMatrix(Matrice_Creuse<double> * const & matrix, Matrice_Creuse<double> * const & more, pfes3 * const & space)
// The matrix of the rank's elements goes to PETSc, and is emptied. more: is added to it, of all elements, may be empty.
{
    HashMatrix<int, double> & A = *matrix->pHM();
    std::vector<double> at;
    placeNodes(*(FESpace3 *) **space, at);
    if (at != place) ExecError("multigrid: the nodes are not those that were cut into parts");
    apart.clear();
    {
        std::vector<PetscInt> start, column;
        std::vector<PetscScalar> value;
        std::vector<const HashMatrix<int, double> *> parts(1, &A);
        if (more->pHM()) parts.push_back(more->pHM());
        rowsOf(parts, start, column, value);
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
    setRigidBodies();
    ownHeld.clear();
    for (int n = 0; n < (int) numberOf.size(); n++)
        if (holdOf[n] >= 0 && numberOf[n] >= firstNode && numberOf[n] < firstNode + ownNodes) ownHeld.push_back(n);
    CHECK(MatGetDiagonal(K, work));
    CHECK(VecMax(work, nullptr, &heldStiffness));
    heldStiffness *= 1e20;
    std::vector<double>().swap(place);
    std::vector<int>().swap(ownerOf);
    malloc_trim(0);
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
    // what products of several ranks keep for being made again
    PetscInt count;
    Mat * coarse;
    CHECK(PCGetCoarseOperators(levels, &count, &coarse));
    for (PetscInt l = 0; l + 1 < count; l++)
    {
        CHECK(MatProductClear(coarse[l]));
        CHECK(MatDestroy(&coarse[l]));
    }
    CHECK(PetscFree(coarse));
    malloc_trim(0);
    return 0;
}

// ---------------------------------------------------------------- solves

PetscInt numberOfDof(int dof)
{
    return components * numberOf[dof / components] + dof % components;
}

void spread(const KN_<double> & from, Vec to)
// A field at FreeFEM's dofs, the same on every rank, into PETSc's vector.
{
    double * value;
    CHECK(VecGetArray(to, &value));
    for (int n = 0; n < (int) numberOf.size(); n++)
    {
        PetscInt at = numberOf[n] - firstNode;
        if (at >= 0 && at < ownNodes)
            for (int c = 0; c < components; c++) value[components * at + c] = from[components * n + c];
    }
    CHECK(VecRestoreArray(to, &value));
}

void letGo(Vec v)
// What held nodes are free to do remains.
{
    double * value;
    CHECK(VecGetArray(v, &value));
    for (int n : ownHeld)
    {
        double * at = value + components * (numberOf[n] - firstNode);
        const Projector & P = loose[holdOf[n]];
        const double x = at[0], y = at[1], z = at[2];
        for (int c = 0; c < components; c++) at[c] = P[3 * c] * x + P[3 * c + 1] * y + P[3 * c + 2] * z;
    }
    CHECK(VecRestoreArray(v, &value));
}

void balance(Vec v)
{
    for (Vec motion : rigidMotions)
    {
        PetscScalar share;
        CHECK(VecDot(v, motion, &share));
        CHECK(VecAXPY(v, -share, motion));
    }
}

void heldPart(const KN_<double> & field, std::vector<double> & part)
// At all held nodes what is along what is held; of the others nothing is looked at.
{
    for (int n = 0; n < (int) holdOf.size(); n++)
        if (holdOf[n] >= 0)
            for (int c = 0; c < components; c++)
            {
                part[components * n + c] = field[components * n + c];
                for (int d = 0; d < components; d++)
                    part[components * n + c] -= loose[holdOf[n]][3 * c + d] * field[components * n + d];
            }
}

long multigridFloat(KNM<double> * const & motions)
// ndof x n, orthonormal: what nothing holds.
{
    for (Vec & motion : rigidMotions) CHECK(VecDestroy(&motion));
    rigidMotions.assign(motions->M(), nullptr);
    for (int m = 0; m < motions->M(); m++)
    {
        CHECK(VecDuplicate(load, &rigidMotions[m]));
        spread((*motions)(':', m), rigidMotions[m]);
    }
    return rigidMotions.size();
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
// Forces along what is held move it. Returns the iterations, -1 without convergence.
{
    Vec u = go ? carried : last;
    spread(*forces, load);
    balance(load);
    letGo(load);
    std::vector<double> moved;
    double way = 0, greatest;
    CHECK(VecNorm(load, NORM_INFINITY, &greatest));
    if (!loose.empty())
    {
        moved.assign(forces->N(), 0.);
        heldPart(*forces, moved);
        for (double & x : moved) x /= heldStiffness;
        for (double x : moved) way = std::max(way, std::abs(x));
    }
    // less is what the supports take of other forces
    bool moves = way * heldStiffness > 1e8 * greatest;
    if (moves)
    {
        CHECK(VecSet(work, 0));
        double * f;
        CHECK(VecGetArray(work, &f));
        for (const ApartEntry & e : apart) f[e.row] -= e.value * moved[e.column];
        CHECK(VecRestoreArray(work, &f));
        letGo(work);
        CHECK(VecAXPY(load, 1, work));
    }
    if (go)                                // where it helps: of forces that are all but none the way there would be lost to rounding
    {
        double off, whole;
        letGo(u);
        CHECK(MatMult(K, u, work));
        CHECK(VecAYPX(work, -1, load));
        CHECK(VecNorm(work, NORM_2, &off));
        CHECK(VecNorm(load, NORM_2, &whole));
        if (off > whole) CHECK(VecSet(u, 0));
    }
    CHECK(KSPSetTolerances(solver, tolerance, 1e-300, 1e10, 2000));
    CHECK(KSPSetInitialGuessNonzero(solver, go ? PETSC_TRUE : PETSC_FALSE));
    CHECK(KSPSolve(solver, load, u));
    if (moves)
    {
        double * value;
        CHECK(VecGetArray(u, &value));
        for (int n : ownHeld)
            for (int c = 0; c < components; c++) value[components * (numberOf[n] - firstNode) + c] += moved[components * n + c];
        CHECK(VecRestoreArray(u, &value));
    }
    KSPConvergedReason why;
    PetscInt count;
    CHECK(KSPGetConvergedReason(solver, &why));
    CHECK(KSPGetIterationNumber(solver, &count));
    return why > 0 ? count : -1;
}

Vec balanced(bool ofCarried)
// The displacement without what nothing holds: grounded dofs move then too.
{
    Vec from = ofCarried ? carried : last;
    if (rigidMotions.empty()) return from;
    CHECK(VecCopy(from, work));
    balance(work);
    return work;
}

long multigridWatched(KN<double> * const & field, const bool & ofCarried)
// The displacement at the watched dofs, the others of the field are left as they are.
{
    Vec from = balanced(ofCarried);
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
    collect(balanced(ofCarried), *field);
    return 0;
}

long multigridDiagonal(KN<double> * const & diagonal, const bool & holding)
// Of the matrix; holding: at held dofs, along their own directions, what holds them, else 0.
{
    CHECK(MatGetDiagonal(K, work));
    collect(work, *diagonal);
    for (int d = 0; d < (int) heldDof.size(); d++) if (heldDof[d]) (*diagonal)[d] = holding ? heldStiffness : 0;
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
// K u, as if nothing held the bodies.
{
    spread(*field, work);
    letGo(work);
    CHECK(MatMult(K, work, load));
    std::vector<double> moved(field->N(), 0.), held(components * ownNodes, 0.);
    heldPart(*field, moved);
    // P K P u is there; rows of held nodes lack (1 - P) K u, and all what the ways of held ones do
    double * f;
    CHECK(VecSet(work, 0));
    CHECK(VecGetArray(work, &f));
    for (const ApartEntry & e : apart)
    {
        held[e.row] += e.value * (*field)[e.column];
        f[e.row] += e.value * moved[e.column];
    }
    CHECK(VecRestoreArray(work, &f));
    letGo(work);
    CHECK(VecAXPY(load, 1, work));
    CHECK(VecGetArray(load, &f));
    for (int n : ownHeld)
    {
        int at = components * (numberOf[n] - firstNode);
        const Projector & P = loose[holdOf[n]];
        for (int c = 0; c < components; c++)
        {
            f[at + c] += held[at + c];
            for (int d = 0; d < components; d++) f[at + c] -= P[3 * c + d] * held[at + d];
        }
    }
    CHECK(VecRestoreArray(load, &f));
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
    Global.Add("multigridHold", "(", new OneOperator2_<long, KN<double> *, Matrice_Creuse<double> *>(multigridHold));
    Global.Add("multigridMatrix", "(",
               new OneOperator3_<long, Matrice_Creuse<double> *, Matrice_Creuse<double> *, pfes3 *>(multigridMatrix));
    Global.Add("multigridFloat", "(", new OneOperator1_<long, KNM<double> *>(multigridFloat));
    Global.Add("multigridDiagonal", "(", new OneOperator2_<long, KN<double> *, bool>(multigridDiagonal));
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

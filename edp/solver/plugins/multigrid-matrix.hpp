// multigrid-matrix.hpp: the stiffness over the ranks, with held nodes, and its multigrid levels
// A held node has a projector P onto what it is free to do: the matrix is P K P, and a stiffness of its own along what is held, so
// that directions which are no axes need no dofs of their own. K's entries at held nodes are kept apart: for the forces of the
// supports, and for the load of supports that are moved. The levels are PETSc's GAMG, which is told of the rigid motions.
// multigridHold(released, turning): the projectors; multigridMatrix(matrix, more, space): PETSc's matrix; multigridSetUp(options): its
// levels; multigridRest(): none any more.
#include "multigrid-refine.hpp"

namespace
{
const int modes = 6;                       // translations and rotations

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

long multigridRest()
// The levels are freed; another solve wants multigridSetUp() before it.
{
    CHECK(KSPDestroy(&solver));
    malloc_trim(0);
    return 0;
}
}

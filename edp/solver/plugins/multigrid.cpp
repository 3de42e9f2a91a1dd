// multigrid.cpp: a FreeFEM plugin on PETSc: the stiffness of bodies in space, spread over the ranks, solved by multigrid
// Built by `make mpi`; solver/compliance/multigrid.idp is its only user. Needs PETSc 3.14 or newer; runs in FreeFem++ and FreeFem++-mpi.
// Here: the solves, by conjugate gradients, and the forces K u; multigrid-nodes.hpp and -part.hpp have the nodes, -matrix.hpp the matrix.
// Another list of functions at the end, or another meaning: raise the number in the names of input/without/ and their includes.
// Supports that are moved: a load along what is held, a huge stiffness times the displacement, as the direct engine has it. Bodies
// that nothing holds are grounded at dofs that are held; their rigid motions are taken from loads and displacements.
#include "multigrid-matrix.hpp"

namespace
{
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
    if (!firstVertex.empty()) way = rankMost(way);
    // less is what the supports take of other forces
    bool moves = way * heldStiffness > 1e8 * greatest;
    if (moves && moved.empty()) moved.assign(forces->N(), 0.);
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
    Global.Add("rankCount", "(", new OneOperator0<long>(ranksNow));
    Global.Add("rankIndex", "(", new OneOperator0<long>(rankNow));
    Global.Add("rankBarrier", "(", new OneOperator0<long>(meetRanks));
    Global.Add("firstRankValue", "(", new OneOperator1_<long, long>(firstRankSays));
    Global.Add("multigridMesh", "(", new OneOperator5_<long, pmesh3 *, string *, double, KN<long> *, long>(multigridMesh));
    Global.Add("multigridPartVertices", "(", new OneOperator1_<long, KN<long> *>(multigridVertices));
    Global.Add("multigridOuterSides", "(", new OneOperator1_<long, KN<double> *>(multigridOuter));
    Global.Add("multigridOwnElements", "(", new OneOperator2_<long, pmesh3 *, KN<double> *>(multigridElements));
    Global.Add("multigridMaxDof", "(", new OneOperator1_<long, KN<double> *>(multigridGreatest));
    Global.Add("multigridPartition", "(", new OneOperator2_<long, pfes3 *, KN<double> *>(multigridParts));
    Global.Add("multigridOwned", "(", new OneOperator3_<long, pfes3 *, KN<double> *, KN<double> *>(multigridOwned));
    Global.Add("multigridNodeNumbers", "(", new OneOperator1_<long, KN<double> *>(multigridNumbers));
    Global.Add("multigridGhosts", "(", new OneOperator1_<long, KN<double> *>(multigridGhosts));
    Global.Add("rankSums", "(", new OneOperator1_<long, KN<double> *>(rankSums));
    Global.Add("rankMax", "(", new OneOperator1_<double, double>(rankMost));
    Global.Add("multigridConstrain", "(", new OneOperator2_<long, KN<double> *, Matrice_Creuse<double> *>(multigridHold));
    Global.Add("multigridMatrix", "(",
               new OneOperator3_<long, Matrice_Creuse<double> *, Matrice_Creuse<double> *, pfes3 *>(multigridMatrix));
    Global.Add("multigridSetRigidModes", "(", new OneOperator1_<long, KNM<double> *>(multigridFloat));
    Global.Add("multigridDiagonal", "(", new OneOperator2_<long, KN<double> *, bool>(multigridDiagonal));
    Global.Add("multigridSetUp", "(", new OneOperator1_<long, string *>(multigridSetUp));
    Global.Add("multigridFreeLevels", "(", new OneOperator0<long>(multigridRest));
    Global.Add("multigridSelectDofs", "(", new OneOperator1_<long, KN<long> *>(multigridWatch));
    Global.Add("multigridSolve", "(", new OneOperator3_<long, KN<double> *, double, bool>(multigridSolve));
    Global.Add("multigridSelected", "(", new OneOperator2_<long, KN<double> *, bool>(multigridWatched));
    Global.Add("multigridField", "(", new OneOperator2_<long, KN<double> *, bool>(multigridField));
    Global.Add("multigridUpdateGuess", "(", new OneOperator1_<long, double>(multigridCarry));
    Global.Add("multigridForces", "(", new OneOperator2_<long, KN<double> *, KN<double> *>(multigridForces));
}
}
LOADFUNC(start)

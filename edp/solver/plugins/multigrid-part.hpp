// multigrid-part.hpp: PETSc's numbers of the nodes of a rank's mesh, and what ranks tell each other
// The owner of a vertex is known from the cut; the owner of an edge is that of its end with the smaller number. Included by
// multigrid-refine.hpp alone.
// multigridParts(space, own): the numbers, of a part by its vertices, of a whole mesh by the cut of multigrid-nodes.hpp;
// multigridOwned(space, nodes, elements): 1 at own ones; multigridNumbers(nodes); collect(vector, field); multigridGhosts(field): values
// of nodes of others from their owners; rankSums(values), rankMost(value): over all ranks, the same on all; multigridGreatest(field): the
// dof of all ranks where a field is greatest.
#include "multigrid-cut.hpp"

namespace
{
// ---------------------------------------------------------------- numbers of the nodes

typedef std::pair<int, int> Edge;          // the numbers of its ends, the smaller one first
std::vector<int> nodeInFile;               // of each node its vertex in the file, the greatest number of those in the middle of an edge

int ownerOfVertex(int number)
{
    return std::upper_bound(firstVertex.begin(), firstVertex.end(), number) - firstVertex.begin() - 1;
}

int numberEdges(const std::vector<Edge> & edges, std::vector<int> & number)
// Of own edges their place among them, of others the one that their owner gives. Returns how many are own.
{
    int ranks = ranksNow(), rank = rankNow();
    std::vector<int> mine, asked, toAnswer;
    std::vector<std::vector<int>> of(ranks);
    for (size_t e = 0; e < edges.size(); e++)
    {
        int owner = ownerOfVertex(edges[e].first);
        if (owner == rank) mine.push_back(e);
        else of[owner].push_back(e);
    }
    std::sort(mine.begin(), mine.end(), [&](int a, int b) { return edges[a] < edges[b]; });
    number.assign(edges.size(), -1);
    for (size_t i = 0; i < mine.size(); i++) number[mine[i]] = i;
    std::vector<int> ask(ranks, 0), answer(ranks, 0), askFrom(ranks + 1, 0), answerFrom(ranks + 1, 0);
    for (int r = 0; r < ranks; r++)
    {
        for (int e : of[r]) asked.insert(asked.end(), {edges[e].first, edges[e].second});
        ask[r] = 2 * of[r].size();
    }
    MPI_Alltoall(ask.data(), 1, MPI_INT, answer.data(), 1, MPI_INT, MPI_COMM_WORLD);
    for (int r = 0; r < ranks; r++) askFrom[r + 1] = askFrom[r] + ask[r];
    for (int r = 0; r < ranks; r++) answerFrom[r + 1] = answerFrom[r] + answer[r];
    toAnswer.resize(answerFrom[ranks]);
    MPI_Alltoallv(asked.data(), ask.data(), askFrom.data(), MPI_INT,
                  toAnswer.data(), answer.data(), answerFrom.data(), MPI_INT, MPI_COMM_WORLD);
    std::vector<int> said(toAnswer.size() / 2), heard(asked.size() / 2);
    for (size_t i = 0; i < said.size(); i++)
    {
        Edge edge(toAnswer[2 * i], toAnswer[2 * i + 1]);
        auto at = std::lower_bound(mine.begin(), mine.end(), edge, [&](int a, const Edge & b) { return edges[a] < b; });
        if (at == mine.end() || edges[*at] != edge) ExecError("multigrid: an edge is not known to its owner");
        said[i] = number[*at];
    }
    for (std::vector<int> * half : {&ask, &answer, &askFrom, &answerFrom}) for (int & n : *half) n /= 2;
    MPI_Alltoallv(said.data(), answer.data(), answerFrom.data(), MPI_INT,
                  heard.data(), ask.data(), askFrom.data(), MPI_INT, MPI_COMM_WORLD);
    size_t next = 0;
    for (int r = 0; r < ranks; r++) for (int e : of[r]) number[e] = heard[next++];
    return mine.size();
}

void numberPart(const FESpace3 & V)
// Own vertices, then own edges, rank after rank.
{
    int ranks = ranksNow(), rank = rankNow(), nodes = V.NbOfDF / components, each = nodesOfElement(V);
    std::vector<Edge> ends(nodes), edges;
    for (int k = 0; k < V.Th.nt; k++)
        for (int j = 0; j < each; j++)
        {
            int a = vertexNumber[V.Th(k, j < 4 ? j : Tet::nvedge[j - 4][0])], b = vertexNumber[V.Th(k, j < 4 ? j : Tet::nvedge[j - 4][1])];
            ends[nodeOf(V, k, j)] = Edge(std::min(a, b), std::max(a, b));
        }
    std::vector<int> which, number;
    for (int n = 0; n < nodes; n++)
        if (ends[n].first != ends[n].second)
        {
            which.push_back(n);
            edges.push_back(ends[n]);
        }
    nodeInFile.assign(nodes, std::numeric_limits<int>::max());
    for (int k = 0; k < V.Th.nt && !vertexInFile.empty(); k++)
        for (int j = 0; j < 4; j++) nodeInFile[nodeOf(V, k, j)] = vertexInFile[V.Th(k, j)];
    ownNodes = firstVertex[rank + 1] - firstVertex[rank] + numberEdges(edges, number);
    std::vector<int> first(ranks + 1, 0);
    int own = ownNodes;
    MPI_Allgather(&own, 1, MPI_INT, first.data() + 1, 1, MPI_INT, MPI_COMM_WORLD);
    std::partial_sum(first.begin(), first.end(), first.begin());
    firstNode = first[rank];
    numberOf.resize(nodes);
    for (int n = 0; n < nodes; n++)
    {
        int owner = ownerOfVertex(ends[n].first);
        numberOf[n] = first[owner] + ends[n].first - firstVertex[owner];
    }
    for (size_t i = 0; i < which.size(); i++)
    {
        int owner = ownerOfVertex(ends[which[i]].first);
        numberOf[which[i]] = first[owner] + firstVertex[owner + 1] - firstVertex[owner] + number[i];
    }
}

bool ownNode(int node)
{
    return numberOf[node] >= firstNode && numberOf[node] < firstNode + ownNodes;
}

long multigridParts(pfes3 * const & space, KN<double> * const & own)
// own: 1 at the elements that touch a node of this rank, 0 at the others. Returns the dofs of all ranks.
{
    startPetsc();
    forget();
    keepMemory();
    FESpace3 & V = *(FESpace3 *) **space;
    placeNodes(V, place);
    if (firstVertex.empty()) cutNodes(V.NbOfDF / components);
    else if (V.Th.nt == partElements && V.Th.nv == (int) vertexNumber.size()) numberPart(V);
    else ExecError("multigrid: the mesh is not the part that was cut for this rank");
    for (int k = 0; k < V.Th.nt; k++)
    {
        bool mine = false;
        for (int j = 0; j < nodesOfElement(V); j++) mine = mine || ownNode(nodeOf(V, k, j));
        (*own)[k] = mine;
    }
    long all = ownNodes;
    MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_LONG, MPI_SUM, PETSC_COMM_WORLD);
    return components * all;
}

long multigridOwned(pfes3 * const & space, KN<double> * const & ofNodes, KN<double> * const & ofElements)
// 1 at the nodes of this rank, and at its elements: those whose node with the smallest number it owns. 0 at the others.
{
    FESpace3 & V = *(FESpace3 *) **space;
    for (long n = 0; n < ofNodes->N(); n++) (*ofNodes)[n] = ownNode(n);
    for (int k = 0; k < V.Th.nt; k++)
    {
        int least = nodeOf(V, k, 0);
        for (int j = 1; j < nodesOfElement(V); j++) if (numberOf[nodeOf(V, k, j)] < numberOf[least]) least = nodeOf(V, k, j);
        (*ofElements)[k] = ownNode(least);
    }
    return 0;
}

long multigridNumbers(KN<double> * const & ofNodes)
// PETSc's number of each node.
{
    for (long n = 0; n < ofNodes->N(); n++) (*ofNodes)[n] = numberOf[n];
    return firstNode;
}

// ---------------------------------------------------------------- from all ranks

void scatterTo(Vec from, const std::vector<PetscInt> & blocks, int each, const std::function<void(const double *)> & take)
// The blocks of these numbers, `each` values long, wherever they are.
{
    IS these;
    Vec here;
    VecScatter all;
    const double * value;
    CHECK(ISCreateBlock(PETSC_COMM_SELF, each, blocks.size(), blocks.data(), PETSC_COPY_VALUES, &these));
    CHECK(VecCreateSeq(PETSC_COMM_SELF, each * blocks.size(), &here));
    CHECK(VecScatterCreate(from, these, here, nullptr, &all));
    CHECK(VecScatterBegin(all, from, here, INSERT_VALUES, SCATTER_FORWARD));
    CHECK(VecScatterEnd(all, from, here, INSERT_VALUES, SCATTER_FORWARD));
    CHECK(VecGetArrayRead(here, &value));
    take(value);
    CHECK(VecRestoreArrayRead(here, &value));
    CHECK(VecScatterDestroy(&all));
    CHECK(VecDestroy(&here));
    CHECK(ISDestroy(&these));
}

void collect(Vec from, KN_<double> to)
// A vector at the nodes of this rank's mesh, own ones and others.
{
    std::vector<PetscInt> blocks(numberOf.begin(), numberOf.end());
    int each = to.N() / blocks.size();
    scatterTo(from, blocks, each, [&](const double * value) { for (long i = 0; i < to.N(); i++) to[i] = value[i]; });
}

long multigridGhosts(KN<double> * const & field)
// A field at nodes, or at dofs: at nodes of others the values of their owners replace those that are there.
{
    int each = field->N() / numberOf.size();
    Vec own;
    double * value;
    CHECK(VecCreateMPI(PETSC_COMM_WORLD, each * ownNodes, PETSC_DETERMINE, &own));
    CHECK(VecGetArray(own, &value));
    for (int n = 0; n < (int) numberOf.size(); n++)
        if (ownNode(n)) for (int c = 0; c < each; c++) value[each * (numberOf[n] - firstNode) + c] = (*field)[each * n + c];
    CHECK(VecRestoreArray(own, &value));
    collect(own, *field);
    CHECK(VecDestroy(&own));
    return each;
}

long rankSums(KN<double> * const & values)
// Of each over all ranks; rank 0 sums, so that all have the same digits.
{
    if (!mpiRuns()) return 1;
    std::vector<double> sum(values->N());
    for (long i = 0; i < values->N(); i++) sum[i] = (*values)[i];
    MPI_Reduce(rankNow() == 0 ? MPI_IN_PLACE : sum.data(), sum.data(), sum.size(), MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
    MPI_Bcast(sum.data(), sum.size(), MPI_DOUBLE, 0, MPI_COMM_WORLD);
    for (long i = 0; i < values->N(); i++) (*values)[i] = sum[i];
    return ranksNow();
}

double rankMost(const double & value)
{
    double most = value;
    if (mpiRuns()) MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return most;
}
long multigridGreatest(KN<double> * const & field)
// The dof where a field, right at own nodes, is greatest over all ranks, to rounding; of several the first in the mesh's file, which one
// process would take. -1 on ranks whose mesh does not have its node.
{
    int each = field->N() / numberOf.size();
    double most = -1e300;
    long first = std::numeric_limits<long>::max(), here = -1;
    for (long d = 0; d < field->N(); d++) if (ownNode(d / each)) most = std::max(most, (*field)[d]);
    most = rankMost(most);
    auto number = [&](long d)
    {
        return (long) nodeInFile[d / each] << 32 | ((long) each * numberOf[d / each] + d % each);
    };
    for (long d = 0; d < field->N(); d++)
        if (ownNode(d / each) && (*field)[d] >= most - 1e-9 * std::abs(most)) first = std::min(first, number(d));
    if (mpiRuns()) MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_LONG, MPI_MIN, MPI_COMM_WORLD);
    for (long d = 0; d < field->N(); d++) if (number(d) == first) here = d;
    return here;
}
}

// multigrid-part.hpp: the part of a mesh that a rank holds, and PETSc's numbers of its nodes
// Rank 0 reads the mesh file, cuts its vertices into boxes, and sends each rank its part: the tetrahedra that touch a vertex of its own,
// so that its rows are complete, and those on the surfaces in contact, which every rank has. These come first, in the same order on all
// ranks, so that what is computed on the surfaces is the same everywhere, to the last digit. The owner of an edge is that of its end
// with the smaller number. Included by multigrid-matrix.hpp alone.
// multigridMesh(mesh, file, scale, surfaces): the part as a mesh; multigridParts(space, own): the numbers of its nodes, or, of a whole
// mesh, the cut of multigrid-nodes.hpp; multigridGhosts(field): values of nodes of others from their owners; multigridOwned(nodes,
// elements): 1 at own ones; rankSums(values), rankMost(value): over all ranks, the same on all.
#include "multigrid-nodes.hpp"
#include <cstdio>
#include <cstring>
#include <set>

namespace
{
struct Part
{
    std::vector<double> at;                // coordinates of its vertices
    std::vector<int> tetrahedra;           // four vertices and the region of each
    std::vector<int> triangles;            // three vertices and the label of each, on the boundary
    std::vector<int> number;               // of each vertex, among those of all ranks
};

std::vector<int> firstVertex;              // of each rank, and how many there are; empty: the mesh is whole
std::vector<int> vertexNumber;             // of each vertex of the part
int partElements = 0;                      // its tetrahedra

// ---------------------------------------------------------------- the cut, on rank 0

bool readMesh(const char * name, Part & whole)
// A mesh of gmsh, format 2.2 as text, first order; regions and labels are the physical groups.
{
    FILE * f = fopen(name, "r");
    if (!f) return false;
    char line[512];
    while (fgets(line, sizeof line, f))
    {
        bool nodes = !strncmp(line, "$Nodes", 6), elements = !strncmp(line, "$Elements", 9);
        if (!nodes && !elements) continue;
        if (!fgets(line, sizeof line, f)) break;
        int count = atoi(line);
        if (nodes) whole.at.assign(3l * count, 0.);
        for (int k = 0; k < count && fgets(line, sizeof line, f); k++)
        {
            char * word = line;
            long number = strtol(word, &word, 10);
            if (nodes && (number < 1 || number > count))
            {
                fclose(f);
                return false;
            }
            for (int c = 0; c < 3 && nodes; c++) whole.at[3 * (number - 1) + c] = strtod(word, &word);
            if (nodes) continue;
            int kind = strtol(word, &word, 10), tags = strtol(word, &word, 10), group = 0;
            for (int t = 0; t < tags; t++)
            {
                int tag = strtol(word, &word, 10);
                if (t == 0) group = tag;
            }
            std::vector<int> * to = kind == 4 ? &whole.tetrahedra : kind == 2 ? &whole.triangles : nullptr;
            if (!to) continue;
            for (int c = 0; c < (kind == 4 ? 4 : 3); c++) to->push_back(strtol(word, &word, 10) - 1);
            to->push_back(group);
        }
    }
    fclose(f);
    return !whole.tetrahedra.empty();
}

void numberVertices(Part & whole, int ranks)
// Owners by boxes; of vertices without an element none.
{
    int vertices = whole.at.size() / 3;
    std::vector<char> used(vertices, 0);
    for (size_t t = 0; t < whole.tetrahedra.size(); t += 5) for (int k = 0; k < 4; k++) used[whole.tetrahedra[t + k]] = 1;
    std::vector<int> order;
    for (int v = 0; v < vertices; v++) if (used[v]) order.push_back(v);
    ownerOf.assign(vertices, ranks);
    place.swap(whole.at);
    cut(order.begin(), order.end(), 0, ranks);
    place.swap(whole.at);
    firstVertex.assign(ranks + 2, 0);
    for (int v = 0; v < vertices; v++) firstVertex[ownerOf[v] + 1]++;
    std::partial_sum(firstVertex.begin(), firstVertex.end(), firstVertex.begin());
    firstVertex.pop_back();
    std::vector<int> next(firstVertex);
    whole.number.resize(vertices);
    for (int v = 0; v < vertices; v++) whole.number[v] = next[ownerOf[v]]++;
}

struct Boundary
{
    std::vector<std::array<int, 2>> owners;    // the tetrahedra with each triangle as a side, -1: none
    std::vector<char> below;                   // 1: a side of the tetrahedron is on a surface of these labels
    std::vector<char> onSurface;               // 1: the vertex belongs to such a tetrahedron
};

void findBoundary(const Part & whole, const std::set<int> & labels, Boundary & found)
{
    size_t triangles = whole.triangles.size() / 4, tetrahedra = whole.tetrahedra.size() / 5;
    std::vector<std::array<int, 4>> sides(triangles);      // three vertices in order, and the triangle
    std::vector<char> corner(whole.number.size(), 0);
    for (size_t t = 0; t < triangles; t++)
    {
        const int * v = &whole.triangles[4 * t];
        sides[t] = {v[0], v[1], v[2], (int) t};
        std::sort(sides[t].begin(), sides[t].begin() + 3);
        for (int c = 0; c < 3; c++) corner[v[c]] = 1;
    }
    std::sort(sides.begin(), sides.end());
    found.owners.assign(triangles, {-1, -1});
    found.below.assign(tetrahedra, 0);
    found.onSurface.assign(whole.number.size(), 0);
    for (size_t k = 0; k < tetrahedra; k++)
    {
        const int * T = &whole.tetrahedra[5 * k];
        if (corner[T[0]] + corner[T[1]] + corner[T[2]] + corner[T[3]] < 3) continue;
        for (int out = 0; out < 4; out++)
        {
            std::array<int, 4> side{T[(out + 1) % 4], T[(out + 2) % 4], T[(out + 3) % 4], -1};
            std::sort(side.begin(), side.begin() + 3);
            for (auto at = std::lower_bound(sides.begin(), sides.end(), side);
                 at != sides.end() && std::equal(side.begin(), side.begin() + 3, at->begin()); ++at)
            {
                int t = (*at)[3];
                found.owners[t][found.owners[t][0] >= 0] = k;
                found.below[k] |= labels.count(whole.triangles[4l * t + 3]) > 0;
            }
        }
        for (int c = 0; c < 4 && found.below[k]; c++) found.onSurface[T[c]] = 1;
    }
}

void takePart(const Part & whole, int rank, const Boundary & boundary, Part & part)
// The part of a rank, with every boundary triangle of its tetrahedra.
{
    part = Part();
    std::vector<int> here(whole.number.size(), -1), vertices, elements;
    std::vector<char> taken(boundary.below.size(), 0);
    for (int pass = 0; pass < 2; pass++)
        for (size_t k = 0; k < taken.size(); k++)
        {
            const int * T = &whole.tetrahedra[5 * k];
            bool touched = false;
            for (int c = 0; c < 4; c++) touched = touched || ownerOf[T[c]] == rank;
            if (pass == 0 ? !boundary.below[k] : boundary.below[k] || !touched) continue;
            taken[k] = 1;
            elements.push_back(k);
        }
    for (int k : elements)
        for (int c = 0; c < 4; c++)
        {
            int v = whole.tetrahedra[5l * k + c];
            if (here[v] < 0) vertices.push_back(v);
            here[v] = 0;
        }
    std::sort(vertices.begin(), vertices.end(), [&](int a, int b)
    {
        char at = boundary.onSurface[a], bt = boundary.onSurface[b];
        return at != bt ? at > bt : a < b;
    });
    for (size_t i = 0; i < vertices.size(); i++) here[vertices[i]] = i;
    for (int v : vertices)
    {
        part.number.push_back(whole.number[v]);
        for (int c = 0; c < 3; c++) part.at.push_back(whole.at[3l * v + c]);
    }
    for (int k : elements)
        for (int c = 0; c < 5; c++)
            part.tetrahedra.push_back(c < 4 ? here[whole.tetrahedra[5l * k + c]] : whole.tetrahedra[5l * k + c]);
    for (size_t t = 0; t < boundary.owners.size(); t++)
    {
        const int * v = &whole.triangles[4 * t];
        bool its = false;
        for (int k : boundary.owners[t]) its = its || (k >= 0 && taken[k]);
        for (int c = 0; c < 4 && its; c++) part.triangles.push_back(c < 3 ? here[v[c]] : v[c]);
    }
}

// ---------------------------------------------------------------- the part on its rank

template <class Value> void passOn(std::vector<Value> & values, int from, int to, MPI_Datatype kind)
{
    int mine = rankNow(), count = values.size();
    if (from == to || (mine != from && mine != to)) return;
    if (mine == from)
    {
        MPI_Send(&count, 1, MPI_INT, to, 0, MPI_COMM_WORLD);
        MPI_Send(values.data(), count, kind, to, 0, MPI_COMM_WORLD);
        return;
    }
    MPI_Recv(&count, 1, MPI_INT, from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    values.resize(count);
    MPI_Recv(values.data(), count, kind, from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}

bool prime(size_t n)
{
    for (size_t d = 2; d * d <= n; d++) if (n % d == 0) return false;
    return n > 1;
}

void findNeighbours(Mesh3 & M)
// As Mesh3::BuildAdj() leaves them, with a prime number of buckets: with FreeFEM's, the number of vertices, most sides come into a few
// where that number has many factors of two.
{
    typedef SortArray<int, 3> Side;
    size_t buckets = 2l * M.nt + 1;
    while (!prime(buckets)) buckets++;
    HashTable<Side, int> seen(4l * M.nt, buckets);
    M.TheAdjacencesLink = new int[4l * M.nt];
    M.BoundaryElementHeadLink = new int[M.nbe];
    for (int n = 0; n < 4 * M.nt; n++)
    {
        Side side(M.itemadj(n / 4, n % 4));
        auto other = seen.find(side);
        M.TheAdjacencesLink[n] = other ? other->v : -1;
        if (other) M.TheAdjacencesLink[other->v] = n;
        else seen.add(side, n);
    }
    for (int e = 0; e < M.nbe; e++)
    {
        int turned, own;
        auto of = seen.find(Side(M.itembe(e, &turned)));
        if (!of) ExecError("multigrid: a boundary triangle belongs to no element");
        M.itemadj(of->v / 4, of->v % 4, &own);
        if (M.TheAdjacencesLink[of->v] < 0 && own != turned) M.borderelements[e].changeOrientation();
        M.BoundaryElementHeadLink[e] = of->v;
    }
}

Mesh3 * meshOf(Part & part)
// FreeFEM's mesh; the arrays of the part are given back on the way.
{
    Mesh3 * made = new Mesh3();
    Mesh3 & M = *made;
    M.set(part.number.size(), part.tetrahedra.size() / 5, part.triangles.size() / 4);
    for (int i = 0; i < M.nv; i++)
    {
        M.vertices[i].x = part.at[3l * i];
        M.vertices[i].y = part.at[3l * i + 1];
        M.vertices[i].z = part.at[3l * i + 2];
        M.vertices[i].lab = 0;
    }
    std::vector<double>().swap(part.at);
    for (int t = 0; t < M.nt; t++)
    {
        int * corner = &part.tetrahedra[5l * t];
        M.elements[t].set(M.vertices, corner, corner[4]);
        if (M.elements[t].mesure() <= 0)
        {
            std::swap(corner[2], corner[3]);
            M.elements[t].set(M.vertices, corner, corner[4]);
        }
        M.mes += M.elements[t].mesure();
    }
    std::vector<int>().swap(part.tetrahedra);
    for (int e = 0; e < M.nbe; e++)
    {
        int * corner = &part.triangles[4l * e];
        M.borderelements[e].set(M.vertices, corner, corner[3]);
        M.mesb += M.borderelements[e].mesure();
    }
    std::vector<int>().swap(part.triangles);
    M.BuildBound();
    findNeighbours(M);
    M.Buildbnormalv();
    M.BuildjElementConteningVertex();
    return made;
}

long multigridMesh(pmesh3 * const & mesh, string * const & file, const double & scale, KN<long> * const & surfaces)
// This rank's part of the mesh in the file, which rank 0 reads; surfaces: the labels that every rank has. Returns the vertices of all
// ranks, 0 if the file cannot be read, less than 0 if there are too few for the ranks.
{
    startPetsc();
    keepMemory();
    int ranks = ranksNow(), rank = rankNow();
    std::set<int> labels;
    for (long k = 0; k < surfaces->N(); k++) labels.insert((*surfaces)[k]);
    Part part;
    int vertices = 0;
    {
        Part whole, other;
        Boundary boundary;
        if (rank == 0 && readMesh(file->c_str(), whole))
        {
            numberVertices(whole, ranks);
            vertices = firstVertex[ranks];
            if (vertices < 8 * ranks) vertices = -vertices;
        }
        MPI_Bcast(&vertices, 1, MPI_INT, 0, MPI_COMM_WORLD);
        if (vertices <= 0) return vertices;
        firstVertex.resize(ranks + 1);
        MPI_Bcast(firstVertex.data(), ranks + 1, MPI_INT, 0, MPI_COMM_WORLD);
        if (rank == 0) findBoundary(whole, labels, boundary);
        for (int r = ranks - 1; r >= 0; r--)
        {
            Part & to = r == rank ? part : other;
            if (rank == 0) takePart(whole, r, boundary, to);
            passOn(to.at, 0, r, MPI_DOUBLE);
            passOn(to.tetrahedra, 0, r, MPI_INT);
            passOn(to.triangles, 0, r, MPI_INT);
            passOn(to.number, 0, r, MPI_INT);
        }
    }
    std::vector<int>().swap(ownerOf);
    vertexNumber = part.number;
    partElements = part.tetrahedra.size() / 5;
    for (double & x : part.at) x *= scale;
    Mesh3 * made = meshOf(part);
    if (*mesh) (*mesh)->destroy();
    *mesh = made;
    malloc_trim(0);
    return vertices;
}

// ---------------------------------------------------------------- numbers of the nodes

typedef std::pair<int, int> Edge;          // the numbers of its ends, the smaller one first

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
}

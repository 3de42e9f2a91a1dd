// multigrid-cut.hpp: the part of a mesh that a rank holds, cut out of the mesh file by rank 0
// A part has the tetrahedra that touch a vertex of the rank, so that its rows are complete, and those on the surfaces in contact, which
// every rank has. These come first, in the same order on all ranks, so that what is computed on the surfaces is the same everywhere, to
// the last digit. The label 0 stands for all of the bodies' boundary, sides without a triangle included. Rank 0 reads the file and sends
// each rank its part. Included by multigrid-part.hpp alone.
// firstVertex, vertexNumber, partElements; multigridMesh(mesh, file, scale, surfaces, halved): the part as a mesh; of the last one:
// multigridVertices(numbers): vertices of the file become those of the part; multigridOuter(sides): which sides are the bodies' boundary.
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
    std::vector<int> inFile;               // of each vertex, in the file
    std::vector<int> outer;                // of each tetrahedron, a bit for each corner: the side opposite is on the boundary; or empty
};

std::vector<int> firstVertex;              // of each rank, and how many there are; empty: the mesh is whole
std::vector<int> vertexNumber;             // of each vertex of the part
int partElements = 0;                      // its tetrahedra
std::vector<int> vertexInFile, outerSides; // as in Part, where all of the boundary has been asked for

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
    std::vector<int> outer;                    // as in Part
};

void findOuter(const Part & whole, std::vector<int> & outer)
// The sides that one tetrahedron alone has.
{
    size_t tetrahedra = whole.tetrahedra.size() / 5;
    std::vector<std::array<int, 4>> sides(4 * tetrahedra);
    for (size_t n = 0; n < sides.size(); n++)
    {
        const int * T = &whole.tetrahedra[5 * (n / 4)];
        for (int c = 0; c < 3; c++) sides[n][c] = T[(n + c + 1) % 4];
        std::sort(sides[n].begin(), sides[n].begin() + 3);
        sides[n][3] = n;
    }
    std::sort(sides.begin(), sides.end());
    outer.assign(tetrahedra, 0);
    auto same = [](const std::array<int, 4> & a, const std::array<int, 4> & b) { return std::equal(a.begin(), a.begin() + 3, b.begin()); };
    for (size_t i = 0; i < sides.size(); i++)
    {
        bool shared = (i > 0 && same(sides[i], sides[i - 1])) || (i + 1 < sides.size() && same(sides[i], sides[i + 1]));
        if (!shared) outer[sides[i][3] / 4] |= 1 << sides[i][3] % 4;
    }
}

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
    if (labels.count(0)) findOuter(whole, found.outer);
    for (size_t k = 0; k < tetrahedra; k++)
    {
        const int * T = &whole.tetrahedra[5 * k];
        if (!found.outer.empty()) found.below[k] = found.outer[k] != 0;
        bool beside = corner[T[0]] + corner[T[1]] + corner[T[2]] + corner[T[3]] >= 3;
        for (int out = 0; out < 4 && beside; out++)
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
        part.inFile.push_back(v);
        for (int c = 0; c < 3; c++) part.at.push_back(whole.at[3l * v + c]);
    }
    for (int k : elements)
        for (int c = 0; c < 5; c++)
            part.tetrahedra.push_back(c < 4 ? here[whole.tetrahedra[5l * k + c]] : whole.tetrahedra[5l * k + c]);
    if (!boundary.outer.empty()) for (int k : elements) part.outer.push_back(boundary.outer[k]);
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
            if (!part.outer.empty()) part.outer[t] = (part.outer[t] & 3) | (part.outer[t] & 4) << 1 | (part.outer[t] & 8) >> 1;
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

void refine(Part & part, const std::set<int> & labels);   // multigrid-refine.hpp

long multigridMesh(pmesh3 * const & mesh, string * const & file, const double & scale, KN<long> * const & surfaces, const long & halved)
// This rank's part of the mesh in the file, which rank 0 reads, with its edges halved so often; surfaces: the labels that every rank has.
// Returns the vertices of the file, 0 if it cannot be read, less than 0 if they are too few for the ranks.
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
            passOn(to.inFile, 0, r, MPI_INT);
            passOn(to.outer, 0, r, MPI_INT);
        }
    }
    std::vector<int>().swap(ownerOf);
    for (long k = 0; k < halved; k++) refine(part, labels);
    if (ranks == 1) firstVertex.clear();
    vertexNumber = part.number;
    partElements = part.tetrahedra.size() / 5;
    for (double & x : part.at) x *= scale;
    Mesh3 * made = meshOf(part);
    if (part.outer.empty()) part.inFile.clear();
    vertexInFile.swap(part.inFile);
    outerSides.swap(part.outer);
    if (*mesh) (*mesh)->destroy();
    *mesh = made;
    malloc_trim(0);
    return vertices;
}
long multigridVertices(KN<long> * const & numbers)
// Vertices by their numbers in the file, from 0: those of the part, -1 where it has none.
{
    std::vector<std::pair<int, int>> known;
    for (size_t v = 0; v < vertexInFile.size(); v++) known.emplace_back(vertexInFile[v], v);
    std::sort(known.begin(), known.end());
    for (long i = 0; i < numbers->N(); i++)
    {
        auto at = std::lower_bound(known.begin(), known.end(), std::make_pair((int) (*numbers)[i], -1));
        (*numbers)[i] = at != known.end() && at->first == (*numbers)[i] ? at->second : -1;
    }
    return known.size();
}

long multigridOuter(KN<double> * const & sides)
// By tetrahedron of the part, a bit for each corner: the side opposite is on the bodies' boundary.
{
    for (long t = 0; t < sides->N(); t++) (*sides)[t] = outerSides[t];
    return outerSides.size();
}

long multigridElements(pmesh3 * const & mesh, KN<double> * const & own)
// own: 1 at the elements of this rank, as multigridOwned() has them, before there is a space; 0 at the others.
{
    const Mesh3 & M = **mesh;
    int rank = rankNow();
    for (int t = 0; t < M.nt; t++)
    {
        int least = vertexNumber[M(t, 0)];
        for (int c = 1; c < 4; c++) least = std::min(least, vertexNumber[M(t, c)]);
        (*own)[t] = least >= firstVertex[rank] && least < firstVertex[rank + 1];
    }
    return 0;
}
}

// multigrid-refine.hpp: a rank's part of the mesh with all edges halved: eight tetrahedra for one
// The middle of an edge is a new vertex, which belongs to the owner of the end with the smaller number. The four tetrahedra in the middle
// share the shortest diagonal. Each rank refines its own part; it then takes from that what is its part again, as from a whole mesh.
// Included by multigrid-matrix.hpp alone.
// refine(part, labels): the part, once refined; labels: those of the surfaces that all ranks have.
#include "multigrid-part.hpp"

namespace
{
const int edgeEnds[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

struct Halves
{
    std::vector<long> key;                 // of each edge, by its two vertices, in order
    int vertices;                          // those before

    static long keyOf(int a, int b) { return a < b ? (long) a << 32 | b : (long) b << 32 | a; }

    int middle(int a, int b) const
    {
        return vertices + (std::lower_bound(key.begin(), key.end(), keyOf(a, b)) - key.begin());
    }
};

void numberHalves(const Halves & halves, Part & part)
// The numbers of old vertices and of middles, rank after rank.
{
    int ranks = ranksNow();
    std::vector<Edge> edges;
    for (long key : halves.key)
    {
        int a = part.number[key >> 32], b = part.number[key & 0xffffffff];
        edges.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::vector<int> middle, more(ranks), next(ranks + 1, 0);
    int own = numberEdges(edges, middle);
    MPI_Allgather(&own, 1, MPI_INT, more.data(), 1, MPI_INT, MPI_COMM_WORLD);
    for (int r = 0; r < ranks; r++) next[r + 1] = next[r] + firstVertex[r + 1] - firstVertex[r] + more[r];
    for (size_t e = 0; e < edges.size(); e++)
    {
        int owner = ownerOfVertex(edges[e].first);
        middle[e] += next[owner] + firstVertex[owner + 1] - firstVertex[owner];
    }
    for (int & number : part.number)
    {
        int owner = ownerOfVertex(number);
        number += next[owner] - firstVertex[owner];
    }
    part.number.insert(part.number.end(), middle.begin(), middle.end());
    firstVertex = next;
}

void refine(Part & part, const std::set<int> & labels)
{
    Halves halves;
    halves.vertices = part.number.size();
    for (size_t t = 0; t < part.tetrahedra.size(); t += 5)
        for (auto & e : edgeEnds) halves.key.push_back(Halves::keyOf(part.tetrahedra[t + e[0]], part.tetrahedra[t + e[1]]));
    std::sort(halves.key.begin(), halves.key.end());
    halves.key.erase(std::unique(halves.key.begin(), halves.key.end()), halves.key.end());
    halves.key.shrink_to_fit();
    Part fine;
    fine.number.swap(part.number);
    numberHalves(halves, fine);
    fine.at.swap(part.at);
    for (long key : halves.key)
        for (int c = 0; c < 3; c++) fine.at.push_back(0.5 * (fine.at[3 * (key >> 32) + c] + fine.at[3 * (key & 0xffffffff) + c]));
    auto put = [](std::vector<int> & to, std::initializer_list<int> values) { to.insert(to.end(), values); };
    auto squared = [&](int a, int b)
    {
        double sum = 0;
        for (int c = 0; c < 3; c++) sum += (fine.at[3l * a + c] - fine.at[3l * b + c]) * (fine.at[3l * a + c] - fine.at[3l * b + c]);
        return sum;
    };
    fine.tetrahedra.reserve(8 * part.tetrahedra.size());
    for (size_t t = 0; t < part.tetrahedra.size(); t += 5)
    {
        const int * v = &part.tetrahedra[t];
        int m[6], region = v[4];           // the middles of 01, 02, 03, 12, 13, 23
        for (int e = 0; e < 6; e++) m[e] = halves.middle(v[edgeEnds[e][0]], v[edgeEnds[e][1]]);
        put(fine.tetrahedra, {v[0], m[0], m[1], m[2], region, m[0], v[1], m[3], m[4], region});
        put(fine.tetrahedra, {m[1], m[3], v[2], m[5], region, m[2], m[4], m[5], v[3], region});
        // the middles of opposite edges, and the other four around them
        const int across[3][2] = {{0, 5}, {1, 4}, {2, 3}}, around[3][4] = {{1, 2, 4, 3}, {0, 2, 5, 3}, {0, 1, 5, 4}};
        int shortest = 0;
        for (int d = 1; d < 3; d++)
            if (squared(m[across[d][0]], m[across[d][1]]) < (1 - 1e-9) * squared(m[across[shortest][0]], m[across[shortest][1]]))
                shortest = d;
        for (int k = 0; k < 4; k++)
            put(fine.tetrahedra, {m[across[shortest][0]], m[across[shortest][1]], m[around[shortest][k]],
                                  m[around[shortest][(k + 1) % 4]], region});
    }
    std::vector<int>().swap(part.tetrahedra);
    for (size_t t = 0; t < part.triangles.size(); t += 4)
    {
        const int * v = &part.triangles[t];
        int label = v[3], a = halves.middle(v[1], v[2]), b = halves.middle(v[2], v[0]), c = halves.middle(v[0], v[1]);
        put(fine.triangles, {v[0], c, b, label, c, v[1], a, label, b, a, v[2], label, a, b, c, label});
    }
    std::vector<long>().swap(halves.key);
    ownerOf.resize(fine.number.size());
    for (size_t v = 0; v < fine.number.size(); v++) ownerOf[v] = ownerOfVertex(fine.number[v]);
    Boundary boundary;
    findBoundary(fine, labels, boundary);
    takePart(fine, rankNow(), boundary, part);
    std::vector<int>().swap(ownerOf);
}
}

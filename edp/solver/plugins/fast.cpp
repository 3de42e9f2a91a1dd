// solver/plugins/fast.cpp: FreeFEM's stiffness assembled row by row, entries sorted by counting, searches: built by `make fast`
// Another list of functions at the end, or another meaning: raise the number in the names of input/without/ and their includes.
// Needs: FreeFEM's headers; the FreeFEM that they are of: another one is told 0, and goes its own way.
// Gives: assembleOrdered(K, elementNode, nodeDof, nodeAt, moduli, power, shapes): the lower triangle of linear elasticity's K, known
//        as half, for straight simplices in the plane or in space: tables as fem/elements/element.idp has them; moduli (elements x 2):
//        lambda and mu; functions: shapes/6 times monomials of these powers (functions x 3); sortMatrixRows(K): K in CHOLMOD's order;
//        addMatrixEntries(K, rows, columns, values): adds these to entries of an ordered K; findOpposingTriangles(...): searchTree of
//        contact/surfaces/triangle-tree.idp, by the same sums; squaredDistancesFrom(...): squaredFrom of solver/rigid-modes/chord-influence-space.idp.
// FreeFEM adds each entry to a hash table, and sorts by heap what it then factorises. Here a row is added up where it stands.
//        setBlasThreads(several): from now on several threads of OpenBLAS, at most 4, or one, as from the beginning; returns how many, 0 if the
//        environment says how many and nothing is changed. Threads that wait spin.
// At its load it also defines macros for flags and cases, and answers FreeFEM's clock around statements: see below.
// CHOLMOD copies between its supernodes by four OpenMP threads, whose waking costs more than they save: here it uses one.
#include "ff++.hpp"
#include "AFunction_ext.hpp"
#include "strversionnumber.hpp"
#include <algorithm>
#ifdef __GLIBC__
#include <dlfcn.h>
#include <link.h>
#include <malloc.h>
#include <sys/mman.h>
#endif
#define FOR(i, n) for (int i = 0; i < n; ++i)
typedef HashMatrix<int, double> Hashed;
typedef Matrice_Creuse<double> Matrix;
typedef KNM<long> Whole;
typedef KNM<double> Real;
typedef std::vector<double> Reals;
typedef std::vector<int> Ints;
typedef KN<long> List;
typedef KN<double> Row;

extern "C" {
void omp_set_max_active_levels(int) __attribute__((weak));
int openblas_get_parallel(void) __attribute__((weak));
int openblas_get_num_threads(void) __attribute__((weak));
void openblas_set_num_threads(int) __attribute__((weak));
int blas_thread_shutdown_(void) __attribute__((weak));
}

static bool alike() { return std::abs(VersionNumber() - atof(FREEFEM_VERSION)) < 1e-6; }

// R[(n i + j) d d + d k + l]: on the reference element the integral of d_k of function i times d_l of function j
static Reals products(Whole &power, Real &shapes, int n, int d)
{
    std::vector<long double> R(d * d * n * n, 0.);           // sums of large numbers
    FOR(k, d) FOR(l, d) FOR(a, n) FOR(b, n) {
        int p[3], sum = d;                                   // of x^i y^j z^k: i! j! k! / (i + j + k + d)!
        long double w = double(power(a, k)) * double(power(b, l));
        if (w == 0) continue;
        FOR(c, d) p[c] = power(a, c) + power(b, c) - (c == k) - (c == l);
        FOR(c, d) { w *= tgamma(p[c] + 1.); sum += p[c]; }
        w /= 36 * tgamma(sum + 1.);
        FOR(i, n) FOR(j, n) R[(n * i + j) * d * d + d * k + l] += w * shapes(i, a) * shapes(j, b);
    }
    return Reals(R.begin(), R.end());
}

// d: components, known to the compiler, which unrolls the loops over them
template <int d>
static long assembled(Matrix *pK, Whole *pNode, Whole *pDof, Real *pAt, Real *pModuli, Whole *pPower, Real *pShapes)
{
    Real &at = *pAt, &moduli = *pModuli;
    const int n = pNode->N(), elements = pNode->M(), nodes = pDof->N(), rows = nodes * d;
    const Reals R = products(*pPower, *pShapes, n, d);
    Ints node(n * elements), dof(rows), first(nodes + 1, 0), around(n * elements), mark(nodes, -1), start(rows + 1, 0), I, J;
    FOR(e, elements) FOR(a, n) node[n * e + a] = (*pNode)(a, e);
    FOR(i, nodes) FOR(p, d) dof[d * i + p] = (*pDof)(i, p);
    Reals to(elements * d * d), volume(elements), value, sum; // d r_k / d x_p, the determinant
    FOR(e, elements) {
        double W[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, C[3][3];
        FOR(p, d) FOR(k, d) W[p][k] = at(node[n * e + k + 1], p) - at(node[n * e], p);
        FOR(p, 3) FOR(k, 3) {
            int a = (p + 1) % 3, b = (p + 2) % 3, i = (k + 1) % 3, j = (k + 2) % 3;
            C[k][p] = W[a][i] * W[b][j] - W[a][j] * W[b][i];
        }
        double V = W[0][0] * C[0][0] + W[0][1] * C[1][0] + W[0][2] * C[2][0];
        FOR(k, d) FOR(p, d) to[(e * d + k) * d + p] = C[k][p] / V;
        volume[e] = std::abs(V);
    }
    for (int k : node) ++first[k + 1];
    FOR(i, nodes) first[i + 1] += first[i];
    Ints next(first);
    FOR(k, n * elements) around[next[node[k]]++] = k;
    std::vector<std::pair<int, int>> column;                 // a dof; d times its place among the neighbours, and its component
    FOR(pass, 2) {                                           // first how many entries a row has, then which
        FOR(i, nodes) {
            const int *own = &dof[d * i], last = *std::max_element(own, own + d);
            int near = 0;
            column.clear();
            for (int k = first[i]; k < first[i + 1]; ++k) FOR(b, n) {
                int j = node[around[k] / n * n + b], *of = &dof[d * j];
                if (mark[j] >= 0 || *std::min_element(of, of + d) > last) continue;
                mark[j] = near++;
                FOR(q, d) column.push_back({of[q], d * mark[j] + q});
            }
            if (pass == 0) for (auto &c : column) FOR(p, d) start[own[p] + 1] += c.first <= own[p];
            else {
                std::sort(column.begin(), column.end());
                sum.assign(d * d * near, 0.);
                for (int k = first[i]; k < first[i + 1]; ++k) FOR(b, n) {
                    const int e = around[k] / n, a = around[k] % n, j = mark[node[n * e + b]];
                    if (j < 0) continue;
                    const double *T = &to[e * d * d], *Q = &R[(n * a + b) * d * d], lambda = moduli(e, 0) * volume[e], mu = moduli(e, 1) * volume[e];
                    double G[3][3] = {{0}}, H[3][3] = {{0}}, trace = 0, *S = &sum[d * d * j];
                    FOR(u, d) FOR(v, d) FOR(q, d) H[u][q] += Q[d * u + v] * T[v * d + q];
                    FOR(p, d) FOR(q, d) FOR(u, d) G[p][q] += T[u * d + p] * H[u][q];
                    FOR(p, d) trace += mu * G[p][p];
                    FOR(p, d) FOR(q, d) S[d * p + q] += lambda * G[p][q] + mu * G[q][p] + (p == q) * trace;
                }
                FOR(p, d) for (auto &c : column) if (c.first <= own[p]) {
                    int z = start[own[p]]++;
                    I[z] = own[p];
                    J[z] = c.first;
                    value[z] = sum[d * d * (c.second / d) + d * p + c.second % d];
                }
            }
            for (int k = first[i]; k < first[i + 1]; ++k) FOR(b, n) mark[node[around[k] / n * n + b]] = -1;
        }
        FOR(r, rows * (pass == 0)) start[r + 1] += start[r];
        I.resize(start[rows]), J.resize(start[rows]), value.resize(start[rows]);
    }
    Hashed *K = new Hashed(rows, rows, 0, 1);
    K->set(rows, rows, 1, value.size(), I.data(), J.data(), value.data(), 0, 0);
    K->state = Hashed::sorted_ij;
    pK->A.master(K);
    return 1;
}

long assembledInOrder(Matrix *const &pK, Whole *const &pNode, Whole *const &pDof, Real *const &pAt, Real *const &pModuli,
                      Whole *const &pPower, Real *const &pShapes)
{
    return !alike() ? 0 : (pDof->M() == 2 ? assembled<2> : assembled<3>)(pK, pNode, pDof, pAt, pModuli, pPower, pShapes);
}

long sortedRows(Matrix *const &pK)
{
    Hashed *K = pK->pHM();
    if (!alike() || !K || K->state == Hashed::sorted_ij) return 0;
    FOR(way, 2) {                                            // by columns, then by rows
        Ints i(K->i, K->i + K->nnz), j(K->j, K->j + K->nnz), place((way ? K->n : K->m) + 1, 0);
        Reals value(K->aij, K->aij + K->nnz);
        for (int r : way ? i : j) ++place[r + 1];
        for (size_t r = 1; r < place.size(); ++r) place[r] += place[r - 1];
        for (size_t k = 0; k < i.size(); ++k) {
            int z = place[way ? i[k] : j[k]]++;
            K->i[z] = i[k], K->j[z] = j[k], K->aij[z] = value[k];
        }
    }
    K->ReHash();
    K->state = Hashed::sorted_ij;
    return 1;
}

// all as contact/surfaces/triangle-tree.idp has them; the last two are what is found
long facingTriangles(List *const &pFace, Real *const &pBall, Real *const &pNormal, Real *const &pAt, Real *const &pAlong,
                     Row *const &pLimits, List *const &pFor, List *const &pFound)
{
    List &face = *pFace;
    Real &ball = *pBall, &normal = *pNormal, &at = *pAt, &along = *pAlong;
    Row &limits = *pLimits;
    const double back = limits[0], ahead = limits[1], cosine = limits[2];
    const int balls = ball.M();
    if (!alike()) return 0;
    Ints first(1, 0), place, triangle, todo, level;          // each level's first ball; balls that are to be looked at, the next one last
    for (int count = face.N(); count > 1; count = (count + 1) / 2) first.push_back(first.back() + count);
    first.push_back(balls);
    FOR(p, at.M()) {
        todo.assign(1, balls - 1);
        level.assign(1, first.size() - 2);
        while (!todo.empty()) {
            const int b = todo.back(), l = level.back();
            todo.pop_back(), level.pop_back();
            const double r = ball(3, b), v = at(3, p) + r;
            double away = 0, s = 0;
            FOR(c, 3) {
                const double t = ball(c, b) - at(c, p);
                s += along(c, p) * t;
                away += t * t;
            }
            away -= s * s;
            away -= 1.000001 * (v * v);
            if (!(away <= 0 && ahead + r - s >= 0 && back + r + s >= 0)) continue;
            if (l > 0) {
                const int child = first[l - 1] + 2 * (b - first[l]);
                if (child + 1 < first[l]) todo.push_back(child + 1), level.push_back(l - 1);
                todo.push_back(child), level.push_back(l - 1);
                continue;
            }
            double facing = 0;
            FOR(c, 3) facing -= along(c, p) * normal(c, int(face[b]));
            if (facing > cosine) place.push_back(p), triangle.push_back(face[b]);
        }
    }
    pFor->resize(place.size()), pFound->resize(place.size());
    FOR(k, int(place.size())) (*pFor)[k] = place[k], (*pFound)[k] = triangle[k];
    return 1;
}

// of half a matrix in order, with places for all of these entries
long entriesAdded(Matrix *const &pK, List *const &pRow, List *const &pColumn, Row *const &pValue)
{
    Hashed *K = pK->pHM();
    List &row = *pRow, &column = *pColumn;
    if (!alike() || !K || K->state != Hashed::sorted_ij || !K->half) return 0;
    const int n = row.N();
    Ints start(K->n + 1, 0), place(n);
    FOR(k, int(K->nnz)) ++start[K->i[k] + 1];
    FOR(r, K->n) start[r + 1] += start[r];
    FOR(k, n) {
        const int *last = K->j + start[row[k] + 1], *at = std::lower_bound(K->j + start[row[k]], K->j + start[row[k] + 1], int(column[k]));
        if (at == last || *at != column[k]) return 0;
        place[k] = at - K->j;
    }
    FOR(k, n) K->aij[place[k]] += (*pValue)[k];
    return 1;
}

// points of other contacts than that of point i: 1000 times as far as the farthest, and a length more
long squaresFrom(List *const &pI, Row *const &pX, Row *const &pY, Row *const &pZ, List *const &pContact, long const &i,
                 double const &length, Row *const &pAway)
{
    List &I = *pI, &contact = *pContact;
    Row &X = *pX, &Y = *pY, &Z = *pZ, &away = *pAway;
    const int n = I.N();
    double most = 0;
    if (!alike()) return 0;
    FOR(k, n) {
        const double x = X[I[k]] - X[i], y = Y[I[k]] - Y[i], z = Z[I[k]] - Z[i];
        away[k] = sqrt(x * x + y * y + z * z);
        most = std::max(most, away[k]);
    }
    const double far = 1e3 * (most + length);
    FOR(k, n) if (contact[I[k]] != contact[i]) away[k] = far;
    FOR(k, n) away[k] *= away[k];
    return 1;
}

static long threadsMost = 0;                                 // what OpenBLAS would use, up to 4; 0: the user says how many, or there is no OpenBLAS

long threadsSet(long const &several)
{
    if (!threadsMost) return 0;
    openblas_set_num_threads(several ? threadsMost : 1);
    // those that wait spin for 25 ms each time; by OpenMP they do not
    if (!several && blas_thread_shutdown_ && openblas_get_parallel && openblas_get_parallel() == 1) blas_thread_shutdown_();
    return openblas_get_num_threads();
}

// FreeFEM asks the system for its CPU time around each statement between { }, for showCPU: half a microsecond, ten times the work of most
// statements. The program's call of clock() is led here, and answered at once for these.
#ifdef __GLIBC__
extern bool showCPU;
static char *statements;                                     // FreeFEM's code that runs them, and its length
static size_t statementsLength;

static clock_t clockOfStatements()
{
    return !showCPU && size_t((char *)__builtin_return_address(0) - statements) <= statementsLength ? 0 : clock();
}

// and the memory of arrays that are freed and taken again is kept, not handed back and cleared by the system each time
static void quickenStatements()
{
    mallopt(M_MMAP_THRESHOLD, 32 << 20);
    mallopt(M_TRIM_THRESHOLD, 256 << 20);
    Dl_info object;
    ElfW(Sym) *own = nullptr, *symbols = nullptr;
    link_map *program;
    const char *names = nullptr;
    ElfW(Rela) *call = nullptr;
    size_t length = 0, page = sysconf(_SC_PAGESIZE);
    bool boundAtStart = false;               // else this table is still written to
    statements = (char *)dlsym(RTLD_DEFAULT, "_ZNK10ListOfInstclEPv");
    if (!statements || !dladdr1(statements, &object, (void **)&own, RTLD_DL_SYMENT) || !own) return;
    if (!dladdr1(statements, &object, (void **)&program, RTLD_DL_LINKMAP)) return;
    statementsLength = own->st_size;
    for (ElfW(Dyn) *d = program->l_ld; d->d_tag; ++d) {
        if (d->d_tag == DT_SYMTAB) symbols = (ElfW(Sym) *)d->d_un.d_ptr;
        if (d->d_tag == DT_STRTAB) names = (const char *)d->d_un.d_ptr;
        if (d->d_tag == DT_JMPREL) call = (ElfW(Rela) *)d->d_un.d_ptr;
        if (d->d_tag == DT_PLTRELSZ) length = d->d_un.d_val / sizeof(ElfW(Rela));
        if (d->d_tag == DT_PLTREL && d->d_un.d_val != DT_RELA) return;
        if (d->d_tag == DT_FLAGS) boundAtStart = d->d_un.d_val & DF_BIND_NOW;
    }
    for (; boundAtStart && length-- > 0; ++call) if (!strcmp(names + symbols[call->r_info >> 32].st_name, "clock")) {
        void **place = (void **)(program->l_addr + call->r_offset), *first = (void *)((size_t)place / page * page);
        if (mprotect(first, page, PROT_READ | PROT_WRITE)) return;
        *place = (void *)clockOfStatements;
        mprotect(first, page, PROT_READ);
    }
}
#else
static void quickenStatements() {}
#endif

// Flags whose modules are read on request (input/output.idp): this plugin is loaded before them, and with these macros the script needs no
// second start. A flag that is not here costs one. values: empty for all but 0; unless: scripts with one of these macros do not need it.
static const struct { const char *flag, *values, *word, *unless; } needed[] = {
    {"-half", " 1 ", "symmetryOnRequest", "threeDimensional"},
    {"-order", " 3 4 ", "highOrderOnRequest", "threeDimensional"},
    {"-order", " 3 4 ", "mapOnRequest", "threeDimensional deformableMaster"},
    {"-geometry", " axisymmetric ", "ringsOnRequest", "threeDimensional"},
    {"-distance", " exact ", "exactOnRequest", ""},
    {"-history", " 1 ", "historyOnRequest", ""},
    {"-states", " 1 ", "statesOnRequest", ""},
    {"-sensitivity", " 1 ", "sensitivityOnRequest", ""},
    {"-force", "", "motionsOnRequest", "readModes"},
    {"-method", " paper newton linesearch incremental ", "methodsOnRequest", "eachMethod"},
    {"-law", " exponential barrier table linear ", "lawsOnRequest", "eachLaw"},
};
extern KN<String> *pkarg;
extern long mpisize;

// of FreeFEM's language: defines the macro `word`, unless one of these or itself is there
static std::string macroUnless(const std::string &macros, const std::string &word)
{
    std::istringstream names(macros + " " + word);
    std::string head, end;
    for (std::string name; names >> name; end += "ENDIFMACRO\n") head += "IFMACRO(!" + name + ")\n";
    return head + "macro " + word + "() 1 //\n" + end;
}

static std::string inQuotes(std::string text)
{
    for (size_t i = 0; (i = text.find('\'', i)) != std::string::npos; i += 4) text.replace(i, 1, "'\\''");
    return " '" + text + "'";
}

// What input/reader/ says of a case before its script is read, as requestCaseModules() (input/case/case-flags.idp) asks it: macros, which the
// environment keeps for that function. Nothing if it refuses: then that function asks again, and says why.
static std::string askedOfCase(const std::string &script, const std::string &flags)
{
    const std::string name = script.substr(script.rfind('/') + 1), folder = script.substr(0, script.size() - name.size());
    const bool space = name == "parts-3d.edp";
    const char *from = getenv("CONTACT_FOLDER"), *temporary = getenv("TMPDIR");
    char *edp = realpath(folder.empty() ? "." : folder.c_str(), nullptr);
    std::string text, words, reader, word, answer = std::string(temporary && *temporary ? temporary : "/tmp") + "/modules-XXXXXX";
    if (edp && (space || name == "parts.edp") && flags.find("\n-case\n") != std::string::npos && flags.find("-help\n") == std::string::npos
        && mpisize < 2 && !getenv("CONTACT_REQUESTED") && close(mkstemp(&answer[0])) == 0) {
        std::string command = "sh" + inQuotes(edp + std::string("/input/read.sh")) + " $PPID modules" + inQuotes("to=" + answer) + " own=1 space="
            + (space ? "1" : "0") + inQuotes("flags=" + flags) + " > /dev/null 2>&1";
        if (from && *from) command = "cd" + inQuotes(from) + " && " + command;
        std::ifstream file;
        if (system(command.c_str()) == 0) file.open(answer);
        std::getline(file, reader);
        for (file >> word; file >> word; words += word + " ") text += macroUnless("", word);
        if (words.find("rowsOnRequest ") != std::string::npos) text.clear();    // so have load cases
        if (!text.empty()) setenv("CONTACT_REQUESTED", (" " + words + "caseAsked ").c_str(), 1);
        if (!text.empty()) setenv("CONTACT_READER", reader.c_str(), 1);
        unlink(answer.c_str());
    }
    free(edp);
    return text;
}

static void readAtOnce()
{
    std::string text, script, flags;
    FOR(i, pkarg->N()) {
        const std::string flag = *(*pkarg)[i].getap()[0], value = i + 1 < pkarg->N() ? *(*pkarg)[i + 1].getap()[0] : std::string();
        flags += flag + "\n";
        if (flag == "-rows" || flag == "-vary") return;                  // rows have a starter of their own, which comes first
        if (flag.size() > 4 && flag.substr(flag.size() - 4) == ".edp") script = flag, flags = "\n";
        for (auto &need : needed)
            if (flag == need.flag && (*need.values ? strstr(need.values, (" " + value + " ").c_str()) != nullptr : value != "0"))
                text += macroUnless(need.unless, need.word);
    }
    zzzfff->input(text + askedOfCase(script, flags));
}

static void Load_Init()
{
    if (alike()) readAtOnce();
    if (alike()) quickenStatements();
    CodeAlloc::chunk = std::max<size_t>(CodeAlloc::chunk, 1 << 18);          // FreeFEM sorts its list of statements each time it grows
    bool isUsersChoice = false;
    for (const char *name : {"OPENBLAS_NUM_THREADS", "GOTO_NUM_THREADS", "OMP_NUM_THREADS"}) isUsersChoice |= getenv(name) != nullptr;
    if (!isUsersChoice && openblas_set_num_threads && openblas_get_num_threads) threadsMost = std::min(openblas_get_num_threads(), 4);
    threadsSet(0);
    // OpenBLAS by OpenMP would wait for threads that are not there
    if (omp_set_max_active_levels && openblas_get_parallel && openblas_get_parallel() != 2) omp_set_max_active_levels(0);
    Global.Add("assembleOrdered", "(", new OneOperator7_<long, Matrix *, Whole *, Whole *, Real *, Real *, Whole *, Real *>(assembledInOrder));
    Global.Add("addMatrixEntries", "(", new OneOperator4_<long, Matrix *, List *, List *, Row *>(entriesAdded));
    Global.Add("findOpposingTriangles", "(", new OneOperator8_<long, List *, Real *, Real *, Real *, Real *, Row *, List *, List *>(facingTriangles));
    Global.Add("squaredDistancesFrom", "(", new OneOperator8_<long, List *, Row *, Row *, Row *, List *, long, double, Row *>(squaresFrom));
    Global.Add("setBlasThreads", "(", new OneOperator1_<long, long>(threadsSet));
    Global.Add("sortMatrixRows", "(", new OneOperator1_<long, Matrix *>(sortedRows));
}
LOADFUNC(Load_Init)

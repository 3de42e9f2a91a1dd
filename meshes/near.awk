# near.awk: where contacts are nearest as drawn: read after pick.awk
# Needs: pick.awk's outline, of quadratic pieces, and its pieces' parts and balls; touch.awk's cells; CLOSER, a file, or nothing: the
#        outline is taken as it is.
# Gives: nearest(a, b, grain, margin, shape): how many pieces of the faces a, no larger than grain, have a distance from the faces b, or
#        from an obstacle's shape, at most margin above the least; zone[1 ...] of them; widest: the radius of the largest;
#        askCloser(): adds to CLOSER, which gmsh reads after the outline's sizes, smaller ones where the outline is farther from its
#        faces than the margin; returns whether.
# Between faces that nearly touch, an error e of the outline moves the place where they are nearest by about sqrt(2 R e). An outline
# whose curves cross there is nearest where they cross. Therefore the outline is refined where its error counts. In the plane a piece
# that lies in the other body is in contact.
# of a piece of the outline: 8 times its bow over the square of its chord, with a sign
function curvature(e,   x, y) {
  x = X[e, 1] - X[e, 0]
  y = Y[e, 1] - Y[e, 0]
  return 8 * (x * (Y[e, 2] - Y[e, 0]) - y * (X[e, 2] - X[e, 0])) / ((x * x + y * y) ^ 1.5 + 1e-300)
}
# in space: the greatest of a face, from how far the middles of its pieces' sides are off their corners' planes
function sharpest(f,   e, k, a, b, c, t) {
  if (f in sharpest_) return sharpest_[f]
  for (e = first[f]; e <= last[f]; e++) {
    if (face[e] != f) continue
    normal(e, ne)
    for (k = 0; k < 3; k++) {
      a = (k + 1) % 3; b = k + 3
      c = (X[e, a] - X[e, k]) ^ 2 + (Y[e, a] - Y[e, k]) ^ 2 + (Z[e, a] - Z[e, k]) ^ 2 + 1e-300
      t = 8 / c * ((X[e, b] - X[e, k]) * ne[0] + (Y[e, b] - Y[e, k]) * ne[1] + (Z[e, b] - Z[e, k]) * ne[2])
      if (t * t > sharpest_[f] ^ 2) sharpest_[f] = t < 0 ? -t : t
    }
  }
  return sharpest_[f] += 0
}
# how far a piece of the outline may be off its face: by the change of curvature to its neighbours, which a parabola lacks, and by what
# it lacks of a circle: about four times too much. In space, where neighbours are not known, curvature may change by a quarter within
# its radius
function doubt(e,   c, k, n, t, change, most, alone) {
  ball(e)
  c = 2 * reach[e]
  k = space ? sharpest(face[e]) : curvature(e)
  most = k < 0 ? -k : k
  alone = !space
  change = space ? most ^ 2 * c / 4 : 0
  for (n = e - 1; n <= e + 1 && !space; n += 2) {
    if (n < 1 || n > elements || face[n] != face[e]) continue
    alone = 0
    t = curvature(n)
    if ((t - k) ^ 2 > change ^ 2) change = t < k ? k - t : t - k
    if (t * t > most * most) most = t < 0 ? -t : t
  }
  if (alone) change = most
  return 0.03 * change * c ^ 2 + most ^ 3 * c ^ 4 / 128
}
# of each piece: root[p] the piece of the outline that it is a part of, doubt_[p] the doubt about that
function ready(p) { if (!(p in root)) { root[p] = p; doubt_[p] = doubt(p) } }
# a piece that is too large is replaced by its parts: their numbers; parts smaller than a sixteenth, in space a quarter, tell nothing
# while the doubt is large
function finer(p, grain, margin,   q, k, all) {
  if (reach[p] <= grain || doubt_[p] > margin && reach[p] <= reach[root[p]] / (space ? 4 : 16)) return ""
  q = split_(p)
  for (k = q; k < q + (space ? 4 : 2); k++) { ball(k); root[k] = root[p]; doubt_[k] = doubt_[p]; all = all " " k }
  return all
}
# does a place lie in what the n pieces of `list` surround? by how often a ray along x meets them
function surrounded(px, py, list, n,   i, p, v0, v1, v2, a, b, t, s, odd) {
  for (i = 1; i <= n; i++) {
    p = list[i]
    v0 = CY[p] - py
    if (v0 > reach[p] || -v0 > reach[p] || CX[p] + reach[p] < px) continue
    v0 = Y[p, 0] - py
    v1 = Y[p, 1] - py
    v2 = Y[p, 2] - py
    b = 2 * (v0 + v1 - 2 * v2)
    a = v1 - v0 - b
    # not across the ray: its ends, and the corner of its tangents, are on one side
    if ((v0 < 0) == (v1 < 0) && (v0 < 0) == (v0 + a / 2 < 0)) continue
    t = a * a - 4 * b * v0
    if (t < 0) continue
    # the roots without cancellation
    s = -(a + (a < 0 ? -sqrt(t) : sqrt(t))) / 2
    t = s == 0 ? 0 : v0 / s
    s = b == 0 ? 2 : s / b
    if ((v0 < 0) != (v1 < 0)) {
      if ((t - 0.5) ^ 2 > (s - 0.5) ^ 2) t = s
      odd += ahead(px, p, t)
    } else if (t > 0 && t < 1 && s > 0 && s < 1) odd += ahead(px, p, t) + ahead(px, p, s)
  }
  return odd % 2
}
function ahead(px, p, t) { return X[p, 0] * (1 - t) * (1 - 2 * t) + X[p, 1] * t * (2 * t - 1) + 4 * X[p, 2] * t * (1 - t) > px }
# the boundary of the bodies that have curves of b, and none of a
function boundaryOf(a, b, list,   n, m, w, k, i, d, own, all, known) {
  n = split(a, w, " ")
  for (k = 1; k <= n; k++) { m = split(sidesOf[w[k]], d, " "); for (i = 1; i <= m; i++) own[d[i]] = 1 }
  n = split(b, w, " ")
  for (k = 1; k <= n; k++) {
    m = split(sidesOf[w[k]], d, " ")
    for (i = 1; i <= m; i++) if (!(d[i] in own) && !(d[i] in known)) { known[d[i]] = 1; all = all around[d[i]] }
  }
  n = piecesOf(all, list)
  for (k = 1; k <= n; k++) ball(list[k])
  return n
}
function nearest(a, b, grain, margin, shape,   A, B, M, na, nb, nm, i, k, p, q, s, n, w, v, d, e, t, least, best, near, again, kept, then, cand, mine, deep, some, gap, rounds) {
  na = piecesOf(a, A)
  nb = shape == "" ? piecesOf(b, B) : 0
  if (!na || shape == "" && !nb) return 0
  split(shape, s, " ")
  nm = space || shape != "" ? 0 : boundaryOf(a, b, M)
  pieces = pieces < elements ? elements : pieces
  for (k = 1; k <= nb; k++) { ready(B[k]); mine = mine " " B[k] }
  for (i = 1; i <= na; i++) { ready(A[i]); cand[A[i]] = mine }
  again = 1
  for (rounds = 0; rounds < 40 && again && na < 20000; rounds++) {
    # no less than the least distance: later of the nearest candidates, which are the first
    least = some ? 0 : 1e300
    for (i = 1; i <= na && !some; i++) {
      p = A[i]
      d = shape == "" ? 1e300 : toShape(s, CX[p], CY[p], CZ[p]) + doubt_[p]
      if (d < least) least = d
      n = split(cand[p], w, " ")
      if (rounds && n > 4) n = 4
      for (k = 1; k <= n; k++) {
        q = w[k]
        d = sqrt((CX[p] - CX[q]) ^ 2 + (CY[p] - CY[q]) ^ 2 + (CZ[p] - CZ[q]) ^ 2) + doubt_[p] + doubt_[q]
        if (d < least) least = d
      }
    }
    again = kept = 0
    for (i = 1; i <= na; i++) {
      p = A[i]
      e = least + margin + reach[p] + doubt_[p]
      mine = ""
      best = shape == "" ? 1e300 : toShape(s, CX[p], CY[p], CZ[p])
      near = best <= e
      n = split(cand[p], w, " ")
      for (k = 1; k <= n; k++) {
        q = w[k]
        d = sqrt((CX[p] - CX[q]) ^ 2 + (CY[p] - CY[q]) ^ 2 + (CZ[p] - CZ[q]) ^ 2)
        if (d - reach[q] - doubt_[q] > e) continue
        near = 1
        t = finer(q, 4 * grain, margin)
        if (t == "") t = " " q
        else again = 1
        if (d < best) { best = d; mine = t mine } else mine = mine t
      }
      # of what is not near the other surface, all is in its body or nothing
      if (!near) {
        if (!(p in deep)) deep[p] = nm ? surrounded(CX[p], CY[p], M, nm) : 0
        if (!deep[p]) continue
        some = 1
      }
      t = finer(p, grain, margin)
      if (t != "") again = 1
      n = split(t == "" ? p : t, w, " ")
      for (k = 1; k <= n; k++) { then[++kept] = w[k]; cand[w[k]] = mine; if (p in deep) deep[w[k]] = deep[p] }
    }
    na = kept
    for (i = 1; i <= na; i++) A[i] = then[i]
  }
  # where the error is too large the outline is made again; else at last the distances themselves
  for (i = 1; i <= na; i++) {
    p = A[i]
    n = split(cand[p], w, " ")
    if (shape != "" && doubt_[p] > margin) unsure(p, margin)
    for (k = 1; k <= n; k++) if (doubt_[p] + doubt_[w[k]] > margin) { unsure(p, margin); unsure(w[k], margin) }
  }
  if (finest && ENVIRON["CLOSER"] != "") return 0
  flat = 0.1 * margin
  least = some ? 0 : 1e300
  for (i = 1; i <= na; i++) {
    p = A[i]
    v[1] = CX[p]; v[2] = CY[p]; v[3] = CZ[p]
    gap[i] = shape == "" ? 1e300 : toShape(s, CX[p], CY[p], CZ[p])
    n = split(cand[p], w, " ")
    for (k = 1; k <= n; k++) gap[i] = closest(w[k], v, gap[i])
    if (gap[i] < least) least = gap[i]
  }
  widest = n = 0
  for (i = 1; i <= na; i++) {
    p = A[i]
    if (gap[i] > least + margin && !(p in deep) && nm) deep[p] = surrounded(CX[p], CY[p], M, nm)
    if (gap[i] > least + margin && !deep[p]) continue
    zone[++n] = p
    if (reach[p] > widest) widest = reach[p]
  }
  return n
}
# the outline is to be finer at piece p, if that has a share in the error: it falls with the third power of its size. A piece no
# longer than the margin cannot be farther off
function unsure(p, margin,   t) {
  if (doubt_[p] <= 0.4 * margin || p in unsure_) return
  t = (0.15 * margin / doubt_[p]) ^ (1 / 3)
  t = 2 * reach[root[p]] * (t < 0.1 ? 0.1 : (t > 0.5 ? 0.5 : t))
  if (t < margin / 2) t = margin / 2
  if (!finest || t < finest) finest = t
  unsure_[p] = 1
}
function askCloser(   p, out, n, key, used) {
  out = ENVIRON["CLOSER"]
  if (out == "" || !finest) return 0
  print "closer_ = newp;" >> out
  for (p in unsure_) {
    key = cellAt(p, finest / 2)
    if (key in used) continue
    used[key] = 1
    print "Point(closer_ + " ++n ") = {" sprintf("%.9g, %.9g, %.9g", CX[p], CY[p], CZ[p]) "};" >> out
  }
  print "near_ = newf;\nField[near_] = Distance;\nField[near_].PointsList = {closer_ + 1 : closer_ + " n "};" >> out
  print "fine_ = newf;\nField[fine_] = MathEval;" >> out
  print "Field[fine_].F = Sprintf(\"" sprintf("%.9g+0.25*Max(0,F%%.0f-%.9g)", finest, 2 * finest) "\", near_);" >> out
  print "least_ = newf;\nField[least_] = Min;\nField[least_].FieldsList = {fine_, outline_};" >> out
  print "outline_ = least_;\nBackground Field = outline_;" >> out
  close(out)
  return 1
}

# near.awk: where contacts of the plane are nearest as drawn: read after pick.awk
# Needs: pick.awk's outline, quadratic pieces of curves; CLOSER, a file, or nothing: the outline is taken as it is.
# Gives: nearestCurves(a, b, grain, margin, shape): as nearest() of pick.awk, in the plane;  askCloser(): adds to CLOSER, which gmsh reads
#        after the outline's sizes, smaller ones where the outline is farther from its curves than the margin; returns whether.
# Between curves that nearly touch, an error e of the outline moves the place where they are nearest by about sqrt(2 R e). An outline
# whose curves cross there is nearest where they cross. Therefore the outline is refined where its error counts, and a piece that lies in
# the other body is in contact.
function chordOf(e) { return sqrt((X[e, 1] - X[e, 0]) ^ 2 + (Y[e, 1] - Y[e, 0]) ^ 2) + 1e-300 }
# of a piece of the outline: 8 times its bow over the square of its chord, with a sign
function curvature(e) {
  return 8 * ((X[e, 1] - X[e, 0]) * (Y[e, 2] - Y[e, 0]) - (Y[e, 1] - Y[e, 0]) * (X[e, 2] - X[e, 0])) / chordOf(e) ^ 3
}
# how far a piece of the outline may be off its curve, about four times too much: by the change of curvature to its neighbours, which a
# parabola lacks, and by what it lacks of a circle
function doubt(e,   c, k, n, t, change, most, alone) {
  if (e in doubt_) return doubt_[e]
  c = chordOf(e)
  k = curvature(e)
  most = k < 0 ? -k : k
  alone = 1
  for (n = e - 1; n <= e + 1; n += 2) {
    if (n < 1 || n > elements || face[n] != face[e]) continue
    alone = 0
    t = curvature(n)
    if ((t - k) ^ 2 > change ^ 2) change = t < k ? k - t : t - k
    if (t * t > most * most) most = t < 0 ? -t : t
  }
  if (alone) change = most
  return doubt_[e] = 0.03 * change * c ^ 2 + most ^ 3 * c ^ 4 / 128
}
function rootOf(p) { return p in root ? root[p] : p }
function halves(p,   q) { q = split_(p); root[q] = root[q + 1] = rootOf(p); ball(q); ball(q + 1); return q }
# pieces smaller than this tell nothing, as long as the outline itself is coarse
function grainOf(p, q, grain, allowed,   t) {
  t = rootOf(p)
  if (doubt(t) + (q == "" ? 0 : doubt(rootOf(q))) <= allowed) return grain
  return reach[t] / 16 > grain ? reach[t] / 16 : grain
}
# from a place to the quadratic piece p
function toCurve(px, py, p,   ax, ay, bx, by, t, k, rx, ry, sx, sy, f, g) {
  bx = 2 * (X[p, 0] + X[p, 1] - 2 * X[p, 2]); by = 2 * (Y[p, 0] + Y[p, 1] - 2 * Y[p, 2])
  ax = X[p, 1] - X[p, 0] - bx; ay = Y[p, 1] - Y[p, 0] - by
  rx = X[p, 1] - X[p, 0]; ry = Y[p, 1] - Y[p, 0]
  t = ((px - X[p, 0]) * rx + (py - Y[p, 0]) * ry) / (rx * rx + ry * ry + 1e-300)
  for (k = 0; k < 5; k++) {
    t = t < 0 ? 0 : (t > 1 ? 1 : t)
    rx = X[p, 0] + t * (ax + t * bx) - px; ry = Y[p, 0] + t * (ay + t * by) - py
    sx = ax + 2 * t * bx; sy = ay + 2 * t * by
    g = sx * sx + sy * sy
    f = g + 2 * (rx * bx + ry * by)
    t -= (rx * sx + ry * sy) / (f > 0.1 * g ? f : g + 1e-300)
  }
  t = t < 0 ? 0 : (t > 1 ? 1 : t)
  return sqrt((X[p, 0] + t * (ax + t * bx) - px) ^ 2 + (Y[p, 0] + t * (ay + t * by) - py) ^ 2)
}
# does a place lie in what the n pieces of `list` surround? by how often a ray meets them
function surrounded(px, py, list, n,   i, p, u0, u1, u2, v0, v1, v2, a, b, t, s, odd, cx, cy) {
  cx = cos(0.3); cy = sin(0.3)
  for (i = 1; i <= n; i++) {
    p = list[i]
    v0 = cx * (Y[p, 0] - py) - cy * (X[p, 0] - px)
    v1 = cx * (Y[p, 1] - py) - cy * (X[p, 1] - px)
    v2 = cx * (Y[p, 2] - py) - cy * (X[p, 2] - px)
    b = 2 * (v0 + v1 - 2 * v2)
    a = v1 - v0 - b
    # not across the ray: its ends, and the corner of its tangents, are on one side
    if ((v0 < 0) == (v1 < 0) && (v0 < 0) == (v0 + a / 2 < 0)) continue
    u0 = cx * (X[p, 0] - px) + cy * (Y[p, 0] - py)
    u1 = cx * (X[p, 1] - px) + cy * (Y[p, 1] - py)
    u2 = cx * (X[p, 2] - px) + cy * (Y[p, 2] - py)
    t = a * a - 4 * b * v0
    if (t < 0) continue
    # the roots without cancellation
    s = -(a + (a < 0 ? -sqrt(t) : sqrt(t))) / 2
    t = s == 0 ? 0 : v0 / s
    s = b == 0 ? 2 : s / b
    if ((v0 < 0) != (v1 < 0)) {
      if ((t - 0.5) ^ 2 > (s - 0.5) ^ 2) t = s
      odd += ahead(u0, u1, u2, t)
    } else if (t > 0 && t < 1 && s > 0 && s < 1) odd += ahead(u0, u1, u2, t) + ahead(u0, u1, u2, s)
  }
  return odd % 2
}
function ahead(u0, u1, u2, t) { return u0 * (1 - t) * (1 - 2 * t) + u1 * t * (2 * t - 1) + 4 * u2 * t * (1 - t) > 0 }
# the boundary of the bodies that have curves of b, and none of a
function boundaryOf(a, b, list,   n, m, w, k, i, d, own, all, known) {
  n = split(a, w, " ")
  for (k = 1; k <= n; k++) { m = split(sidesOf[w[k]], d, " "); for (i = 1; i <= m; i++) own[d[i]] = 1 }
  n = split(b, w, " ")
  for (k = 1; k <= n; k++) {
    m = split(sidesOf[w[k]], d, " ")
    for (i = 1; i <= m; i++) if (!(d[i] in own) && !(d[i] in known)) { known[d[i]] = 1; all = all around[d[i]] }
  }
  return piecesOf(all, list)
}
function nearestCurves(a, b, grain, margin, shape,   A, B, M, na, nb, nm, i, j, k, p, q, s, n, w, d, e, least, best, again, kept, A2, cand, cand2, mine, deep, some, gap, rounds) {
  na = piecesOf(a, A)
  nb = shape == "" ? piecesOf(b, B) : 0
  if (!na || shape == "" && !nb) return 0
  split(shape, s, " ")
  nm = shape == "" ? boundaryOf(a, b, M) : 0
  pieces = pieces < elements ? elements : pieces
  mine = ""
  for (j = 1; j <= nb; j++) { ball(B[j]); mine = mine " " B[j] }
  for (i = 1; i <= na; i++) { ball(A[i]); cand[i] = mine }
  for (rounds = 0; rounds < 40; rounds++) {
    least = some ? 0 : 1e300
    for (i = 1; i <= na && !some; i++) {
      p = A[i]
      e = doubt(rootOf(p))
      if (shape != "") { d = toShape(s, X[p, 2], Y[p, 2], 0) + e; if (d < least) least = d; continue }
      n = split(cand[i], w, " ")
      for (k = 1; k <= n; k++) {
        q = w[k]
        d = sqrt((X[p, 2] - X[q, 2]) ^ 2 + (Y[p, 2] - Y[q, 2]) ^ 2) + e + doubt(rootOf(q))
        if (d < least) least = d
      }
    }
    again = kept = 0
    split("", A2); split("", cand2)
    for (i = 1; i <= na; i++) {
      p = A[i]
      e = doubt(rootOf(p))
      mine = ""
      k = 0
      if (shape != "") k = toShape(s, CX[p], CY[p], 0) - reach[p] - e <= least + margin
      n = split(cand[i], w, " ")
      for (j = 1; j <= n; j++) {
        q = w[j]
        d = sqrt((CX[p] - CX[q]) ^ 2 + (CY[p] - CY[q]) ^ 2) - reach[p] - reach[q] - e - doubt(rootOf(q))
        if (d > least + margin) continue
        mine = mine " " q
        k = 1
        if (reach[q] > grainOf(q, p, grain, margin)) again = 1
      }
      # of what is not near the other surface, all is in its body or nothing
      if (!k) {
        if (!(p in deep)) deep[p] = nm ? surrounded(X[p, 2], Y[p, 2], M, nm) : 0
        if (!deep[p]) continue
        some = 1
      }
      A2[++kept] = p
      cand2[kept] = mine
      if (reach[p] > grainOf(p, "", grain, margin)) again = 1
    }
    if (!again || kept > 20000) break
    split("", A); split("", cand)
    na = 0
    for (i = 1; i <= kept; i++) {
      p = A2[i]
      n = split(cand2[i], w, " ")
      mine = ""
      for (k = 1; k <= n; k++) {
        q = w[k]
        if (reach[q] > grainOf(q, p, grain, margin)) { q = halves(q); mine = mine " " q " " q + 1 } else mine = mine " " q
      }
      if (reach[p] > grainOf(p, "", grain, margin)) {
        q = halves(p)
        if (p in deep) deep[q] = deep[q + 1] = deep[p]
        A[++na] = q; cand[na] = mine
        A[++na] = q + 1; cand[na] = mine
      } else { A[++na] = p; cand[na] = mine }
    }
  }
  # at last the distances themselves, and the pieces whose error is too large for them
  least = some ? 0 : 1e300
  for (i = 1; i <= kept; i++) {
    p = A2[i]
    gap[i] = shape == "" ? 1e300 : toShape(s, X[p, 2], Y[p, 2], 0)
    best = 0
    n = split(cand2[i], w, " ")
    for (k = 1; k <= n; k++) {
      q = w[k]
      d = toCurve(X[p, 2], Y[p, 2], q)
      if (d < gap[i]) gap[i] = d
      if (doubt(rootOf(p)) + doubt(rootOf(q)) > margin) { unsure(q, margin); best = 1 }
    }
    if (best || (n || shape != "") && doubt(rootOf(p)) > margin) unsure(p, margin)
    if (gap[i] < least) least = gap[i]
  }
  widest = n = 0
  for (i = 1; i <= kept; i++) {
    p = A2[i]
    if (gap[i] > least + margin && !(p in deep) && nm) deep[p] = surrounded(X[p, 2], Y[p, 2], M, nm)
    if (gap[i] > least + margin && !deep[p]) continue
    zone[++n] = p
    if (reach[p] > widest) widest = reach[p]
  }
  return n
}
# the outline is to be finer at piece p: its error falls with the third power of its size
function unsure(p, margin,   e, t) {
  e = rootOf(p)
  if (doubt(e) < 0.4 * margin) return
  t = (0.3 * margin / doubt(e)) ^ (1 / 3)
  t = chordOf(e) * (t < 0.1 ? 0.1 : (t > 0.5 ? 0.5 : t))
  if (!finest || t < finest) finest = t
  unsure_[p] = 1
}
function askCloser(   p, out, n, key, used, line, f, before) {
  out = ENVIRON["CLOSER"]
  if (out == "" || !finest) return 0
  f = 99999
  before = ""
  while ((getline line < out) > 0) if (line ~ /^Background/) f -= 3
  close(out)
  print "closer_ = newp;" >> out
  for (p in unsure_) {
    key = int(X[p, 2] / finest * 2) " " int(Y[p, 2] / finest * 2)
    if (key in used) continue
    used[key] = 1
    print "Point(closer_ + " ++n ") = {" sprintf("%.9g, %.9g, 0", X[p, 2], Y[p, 2]) "};" >> out
  }
  print "Field[" f - 1 "] = Distance;\nField[" f - 1 "].PointsList = {closer_ + 1 : closer_ + " n "};" >> out
  print "Field[" f - 2 "] = MathEval;\nField[" f - 2 "].F = \"" sprintf("%.9g+0.25*Max(0,F%d-%.9g)", finest, f - 1, 2 * finest) "\";" >> out
  print "Field[" f - 3 "] = Min;\nField[" f - 3 "].FieldsList = {" f - 2 ", " f "};\nBackground Field = " f - 3 ";" >> out
  close(out)
  return 1
}

# cad.awk: cuts through bodies of a geometry, and bodies joined to one part, by gmsh's boolean operations: read after pick.awk
# Needs: pick.awk's arrays; of a geometry before any operation the lines "cut" and "join" of PICKS; after it KEPT and PARENTS, lines
#        "piece N of M" of gmsh's log: body N is a piece of body M.
# Gives: operate(): whether bodies are to be cut or joined: APART gains the operations, KEPT what was picked before.  recall(): whether
#        they have been: groups, faces and bodies of the present outline by the numbers that the geometry had before. A face is a piece
#        of the one that it lies on; a face between two pieces of one body, or between joined bodies, is of none.
#        checkCad(), checkTies(), checkJoins(), findSections(): refusals, and the faces of each cut;  named_(): the file's own names, once more.
# a mesh has no shapes to be cut or joined
function checkCad(   k, f) {
  if (!ENVIRON["MESHED"]) return
  for (k = 1; k <= joins; k++) {
    split(joinLine[k], f, "\t")
    if (f[5] == "part") no(f[2], "join " f[3] " " f[4] " part: a mesh cannot be joined; allowed: with a geometry, or join " f[3] " " f[4] " tie")
  }
}
function checkTies(   k, f) {
  for (k = 1; k <= joins; k++) {
    split(joinLine[k], f, "\t")
    if (f[5] == "tie" && !lies[f[3], f[4]]) no(f[2], "join " f[3] " " f[4] " tie: they touch nowhere, there is a gap between them; allowed: bodies that touch, a contact, or tie SLAVE MASTER with groups of your own")
  }
}
function share(a, b,   k, p) {
  for (k = 1; k <= shared; k++) { split(sharedBy[k], p, " "); if (p[1] == a && p[2] == b || p[1] == b && p[2] == a) return 1 }
  return 0
}
function top(b) { while (b in above) b = above[b]; return b }
function unite(a, b) { a = top(a); b = top(b); if (a != b) above[b] = a }
# bodies that hang together through others and touch without being joined: gmsh meshes what hangs together at once, and stops there
function checkHanging(   n, w, i, j, k, l, p, F, G, nf, ng, a, b) {
  for (k = 1; k <= pairs_; k++) { unite(first_[k], second_[k]); direct[first_[k], second_[k]] = direct[second_[k], first_[k]] = 1 }
  for (k = 1; k <= shared; k++) { split(sharedBy[k], p, " "); unite(p[1], p[2]); direct[p[1], p[2]] = direct[p[2], p[1]] = 1 }
  n = split(entities[dim], w, " ")
  for (i = 1; i < n && pairs_; i++) for (j = i + 1; j <= n; j++) {
    if (top(w[i]) != top(w[j]) || ((w[i], w[j]) in direct)) continue
    nf = split(around[w[i]], F, " "); ng = split(around[w[j]], G, " ")
    for (k = 1; k <= nf; k++) for (l = 1; l <= ng; l++)
      if (F[k] != G[l] && nearBoxes(F[k], G[l]) && oneShape(F[k], G[l]) && (partOn(F[k], G[l]) || partOn(G[l], F[k]))) {
        a = calledBody(w[i]); b = calledBody(w[j])
        split(joinLine[1], p, "\t")
        no(p[2], "join: " (a == "" ? w[i] : a) " and " (b == "" ? w[j] : b) " touch, and joins with other bodies hang them together; allowed: join them as part too, or tie in place of part")
      }
  }
}
# the lines of gmsh for one cut of body b by the plane at p with normal n
function cutBody(b, p, n,   out, tall, flat, k, c, q, size, dir, word) {
  out = ENVIRON["APART"]
  word = space ? "Volume" : "Surface"
  size = sqrt(n[1] * n[1] + n[2] * n[2] + n[3] * n[3])
  for (k = 1; k <= 3; k++) { dir[k] = n[k] / size; c[k] = (low[k - 1] + high[k - 1]) / 2; tall += (c[k] - p[k]) * dir[k] }
  for (k = 1; k <= 3; k++) q[k] = c[k] - tall * dir[k]
  if (space) {
    flat = sqrt(dir[1] * dir[1] + dir[2] * dir[2])
    printf "tool_ = news;\nDisk(tool_) = {0, 0, 0, %.17g};\n", diagonal >> out
    if (flat > 0) printf "Rotate{ {%.17g, %.17g, 0}, {0, 0, 0}, %.17g }{ Surface{tool_}; }\n", -dir[2] / flat, dir[1] / flat, atan2(flat, dir[3]) >> out
    printf "Translate{%.17g, %.17g, %.17g}{ Surface{tool_}; }\n", q[1], q[2], q[3] >> out
  } else {
    print "tool_ = newp;" >> out
    printf "Point(tool_) = {%.17g, %.17g, 0};\n", q[1] - diagonal * dir[2], q[2] + diagonal * dir[1] >> out
    printf "Point(tool_ + 1) = {%.17g, %.17g, 0};\n", q[1] + diagonal * dir[2], q[2] - diagonal * dir[1] >> out
    print "tool_ = newl;\nLine(tool_) = {newp - 2, newp - 1};" >> out
  }
  print "rest_() = " word "{:};\nrest_() -= own" b "_();\nsection_() = BooleanIntersection{ " (space ? "Surface" : "Curve") "{tool_}; Delete; }{ " word "{own" b "_()}; };" >> out
  print "If (#section_())\n  BooleanFragments{ " word "{own" b "_()}; Delete; }{ " (space ? "Surface" : "Curve") "{section_()}; Delete; }\nEndIf" >> out
  print "own" b "_() = " word "{:};\nown" b "_() -= rest_();\nFor k_ In {0 : #own" b "_() - 1}\n  Printf(\"piece %g of %g\", own" b "_(k_), " b ");\nEndFor" >> out
}
# bodies that hang together share their faces: all at once, for two by two a body loses what it shared before
function shareAll(all, name,   out, word) {
  out = ENVIRON["APART"]
  word = space ? "Volume" : "Surface"
  print "rest_() = " word "{:};\nBooleanFragments{ " word "{" all "}; Delete; }{}\nnew_() = " word "{:};\nnew_() -= rest_();" >> out
  print "If (#new_())\n  Printf(\"piece 0 of " name "\");\nEndIf" >> out
}
function operate(   k, n, m, f, w, v, i, j, p, d, some) {
  some = cuts && !ENVIRON["MESHED"]
  for (k = 1; k <= joins; k++) {
    split(joinLine[k], f, "\t")
    if (f[5] != "part") continue
    n = split(members[dim, f[3]], w, " "); m = split(members[dim, f[4]], v, " ")
    for (i = 1; i <= n; i++) for (j = 1; j <= m; j++) if (!share(w[i], v[j])) { pairs_++; first_[pairs_] = w[i]; second_[pairs_] = v[j]; some = 1 }
  }
  if (!some) return 0
  checkHanging()
  print "SetFactory(\"OpenCASCADE\");" >> ENVIRON["APART"]
  n = split(entities[dim], w, " ")
  for (i = 1; i <= n; i++) print "own" w[i] "_() = {" w[i] "};" >> ENVIRON["APART"]
  for (k = 1; k <= cuts; k++) {
    split(cutLine[k], f, "\t")
    for (j = 1; j <= 3; j++) { p[j] = f[4 + j] + 0; v[j] = f[7 + j] + 0 }
    m = split(members[dim, f[4]], d, " ")
    for (i = 1; i <= m; i++) { cutBody(d[i], p, v); isCut[d[i]] = 1 }
  }
  for (k = 1; k <= pairs_; k++) isCut[first_[k]] = 1
  for (i = 1; i <= n; i++) {
    k = top(w[i])
    together[k] = together[k] (together[k] == "" ? "" : ", ") "own" w[i] "_()"
    if (w[i] in isCut) active[k] = 1
  }
  for (k in active) if (together[k] ~ /,/) shareAll(together[k], k)
  close(ENVIRON["APART"])
  keep()
  return 1
}
function keep(   out, key, d, e, k, line, n) {
  out = ENVIRON["KEPT"]
  for (key in members) { split(key, d, SUBSEP); print "group\t" d[1] "\t" d[2] "\t" members[key] > out }
  for (key in named) { split(key, d, SUBSEP); print "named\t" d[1] "\t" named[key] > out }
  for (key in sidesOf) print "side\t" key "\t" sidesOf[key] > out
  for (e = 1; e <= elements; e++) {
    line = ""
    for (k = 0; k < (space ? 6 : 3); k++) line = line sprintf("\t%.17g\t%.17g\t%.17g", X[e, k], Y[e, k], Z[e, k])
    print "piece\t" face[e] line > out
  }
  close(out)
}
function parent(b) { while (b in whole) b = whole[b]; return b }
function recall(   line, f, w, n, k, e, key, d, of, t, i, p, q, both) {
  while (ENVIRON["KEPT"] != "" && (getline line < ENVIRON["KEPT"]) > 0) {
    n = split(line, f, "\t")
    if (f[1] == "group") was[f[2], f[3]] = f[4]
    if (f[1] == "named") fileName[f[2], f[3]] = 1
    if (f[1] == "side") { sidesBefore[f[2]] = f[3]; split(f[3], w, " "); if (w[2] != "") sharedBefore[w[1], w[2]] = sharedBefore[w[2], w[1]] = 1 }
    if (f[1] == "piece") {
      e = elements + ++before
      face[e] = f[2]
      for (k = 0; k < (space ? 6 : 3); k++) { X[e, k] = f[3 + 3 * k]; Y[e, k] = f[4 + 3 * k]; Z[e, k] = f[5 + 3 * k] }
    }
  }
  if (!before) return 0
  pieces = elements + before
  while ((getline line < ENVIRON["PARENTS"]) > 0) {
    split(line, w, " ")
    if (w[2] + 0 == 0) overlaps_ = 1
    else if (w[2] != w[4]) whole[w[2]] = w[4]
  }
  n = split(entities[dim], w, " ")
  for (k = 1; k <= n; k++) newOf[dim, parent(w[k])] = newOf[dim, parent(w[k])] " " w[k]
  n = split(entities[dim - 1], w, " ")
  for (k = 1; k <= n; k++) {
    p = split(sidesOf[w[k]], both, " ") ? parent(both[1]) : 0
    q = both[2] == "" ? 0 : parent(both[2])
    if (q && p == q) { cutFace[w[k]] = p; wasFace[w[k]] = -w[k]; continue }
    if (q) joinedAt[p, q] = joinedAt[q, p] = 1
    if (q && !((p, q) in sharedBefore)) { wasFace[w[k]] = liesOn(w[k], p, 0); continue }
    t = wasFace[w[k]] = liesOn(w[k], p, q)
    if (t != "") newOf[dim - 1, t] = newOf[dim - 1, t] " " w[k]
  }
  split("", members)
  for (key in was) {
    split(key, d, SUBSEP)
    n = split(was[key], w, " ")
    of = ""
    for (i = 1; i <= n; i++) of = of newOf[d[1], w[i]]
    members[key] = of
  }
  return 1
}
# the face of before, of body p (and q), on which a face lies: at the middle of its largest piece
function liesOn(number, p, q,   list, n, i, e, most, large, r, best, found, t, sides) {
  n = piecesOf(number, list)
  for (i = 1; i <= n; i++) { ball(list[i]); if (reach[list[i]] > most) { most = reach[list[i]]; large = list[i] } }
  best = 1e300
  for (e = elements + 1; e <= elements + before; e++) {
    sides = sidesBefore[face[e]] " "
    if (index(sides, " " p " ") == 0 || (q && index(sides, " " q " ") == 0)) continue
    ball(e)
    if (sqrt((CX[e] - CX[large]) ^ 2 + (CY[e] - CY[large]) ^ 2 + (CZ[e] - CZ[large]) ^ 2) - reach[e] > best || !along(e, large)) continue
    for (r = split_(e) + (space ? 3 : 1); r >= parts[e]; r--) {
      t = away(CX[large], CY[large], CZ[large], r)
      if (t < best) { best = t; found = face[e] }
    }
  }
  return found
}
function meetings(a, b, among,   n, m, w, v, i, j, count) {
  n = split(a, w, " "); m = split(b, v, " ")
  for (i = 1; i <= n; i++) for (j = 1; j <= m; j++) if ((w[i], v[j]) in among) count++
  return count + 0
}
function checkJoins(   k, f, a, b, key, p) {
  for (k = 1; k <= joins; k++) {
    split(joinLine[k], f, "\t")
    a = was[dim, f[3]]; b = was[dim, f[4]]
    if (f[5] != "part") continue
    if (overlaps_) no(f[2], "join " f[3] " " f[4] " part: bodies of it overlap; allowed: bodies that touch, or join " f[3] " " f[4] " contact")
    if (!meetings(a, b, joinedAt)) no(f[2], "join " f[3] " " f[4] " part: they share no face, there is a gap between them; allowed: bodies that touch, or a contact")
  }
  for (key in sharedBefore) if (!(key in joinedAt)) lost = key
  if (overlaps_ || lost != "") {
    split(cuts ? cutLine[1] : joinLine[1], f, "\t")
    no(f[2], f[1] " " f[3] ": bodies that share a face with others cannot be cut or joined so; allowed: in the geometry")
  }
}
# of each cut: the faces between pieces of its body that lie in its plane
function findSections(   k, f, j, v, n, w, key, found, e, t, size, least, most) {
  for (k = 1; k <= cuts; k++) {
    split(cutLine[k], f, "\t")
    for (j = 1; j <= 6; j++) v[j] = f[4 + j] + 0
    found = ""
    for (key in cutFace) if (index(was[dim, f[4]] " ", " " cutFace[key] " ") && within(key, "plane", v)) found = found " " key
    if (found == "") {
      size = sqrt(v[4] * v[4] + v[5] * v[5] + v[6] * v[6])
      least = 1e300; most = -1e300
      for (e = elements + 1; e <= elements + before; e++) {
        n = split(sidesBefore[face[e]], w, " ")
        if (!index(was[dim, f[4]] " ", " " w[1] " ") && !(n > 1 && index(was[dim, f[4]] " ", " " w[2] " "))) continue
        for (j = 0; j < (space ? 6 : 3); j++) {
          t = ((X[e, j] - v[1]) * v[4] + (Y[e, j] - v[2]) * v[5] + (Z[e, j] - v[3]) * v[6]) / size
          if (t < least) least = t
          if (t > most) most = t
        }
      }
      no(f[2], "cut " f[3] ": the plane does not cross " f[4] sprintf(", which lies from %.4g to %.4g along the normal from its point; allowed: a point between", least, most))
    }
    members[dim - 1, f[3]] = found
    if (ENVIRON["TABLE"] != "") tellCut(f[3], f[4], found)
  }
}
# names of the file's own, whose faces have new numbers
function named_(   key, d, word) {
  print "Delete Physicals;"
  for (key in fileName) {
    split(key, d, SUBSEP)
    if (d[1] < dim - 1 || members[key] == "") continue
    word = d[1] == 3 ? "Volume" : (d[1] == 2 ? "Surface" : "Curve")
    print "Physical " word "(\"" d[2] "\") = {" joined(members[key]) "};"
    if (d[1] == dim) { n = split(members[key], w, " "); for (k = 1; k <= n; k++) inGroup[w[k]] = 1 }
  }
}

# case-grammar.awk: the statements of a case file: what each takes, what it does, and the words that others use for it
# Read by awk between case-words.awk and case-file.awk: tables, made once from SPACE, 0 in the plane, 1 in space.
# usage[statement]: what may stand in its line; does[statement], leads[word], instead[word]: for who writes another word;
# example[statement]: a line of its own;
# takes[law], parameter[name], low, high: the laws' parameters, their places and open intervals; isShape[shape]: of obstacles.
BEGIN {
  space = ENVIRON["SPACE"] + 0
  dim = 2 + space
  rubs = ENVIRON["RUBS"] != ""
  split("curve surface volume", kind, " ")
  kind[0] = "point"
  at3 = space ? " z" : ""
  usage["units"] = "units LENGTH PRESSURE, as units mm MPa"
  usage["state"] = "state strain, stress or axisymmetric"
  usage["thickness"] = "thickness NUMBER"
  usage["body"] = "body NAME E number nu number [yield number] [density number]"
  usage["stresses"] = "stresses"
  usage["line"] = "line NAME x y" at3 " x y" at3
  usage["expand"] = "expand NAME alpha dT, two numbers"
  usage["preload"] = "preload NAME force"
  usage["plastic"] = "plastic BODY yield hardening, two numbers"
  usage["conduct"] = "conduct BODY k [expand alpha [from T]]"
  usage["temperature"] = "temperature NAME T"
  usage["flux"] = "flux NAME q"
  usage["film"] = "film NAME h T"
  place3 = space ? " 0" : ""
  split("thickness 12|body pin E 210e3 nu 0.3|line middle 0 0" place3 " 0 20" place3 "|expand ring 12e-6 -180|preload cut 8000" \
    "|plastic core 350 2000|conduct ring 0.05 expand 12e-6 from 20|temperature base 20|flux top 0.3|film outside 25e-6 20" \
    "|contact bore pin friction 0.15|obstacle top " (space ? "sphere 0 0 12 R 10 move 0 0 -0.1" : "circle 0 12 R 10 move 0 -0.1") \
    "|clamp base|symmetry left|move grip 0" place3 " -0.05|rotate core 0 0" (space ? " 0 0 0 1" : "") " 0.01|force grip 0" place3 " -2500 free" \
    "|moment core 21600" (space ? " axis 0 0 1" : "") "|about axle 0 0" place3 "|spring base 1e4 1e4" (space ? " 1e4" : "") \
    "|spin rotor 1500" (space ? " about 0 0 0 axis 0 0 1" : "") "|gravity 0" place3 " -9810|pressure top 12|traction top 0" place3 " -5" \
    "|leg 8|tie pad disc|weight core 0" place3 " -77e-6|cut waist bolt plane 0 0" place3 " 0 1" place3 "|join bolt plate contact|group bore near 12 0" place3 "|size contact 0.05|state axisymmetric", list, "|")
  for (k in list) { line = list[k]; sub(/ .*/, "", line); example[line] = list[k] }
  example["law"] = "law power kappa 1e6 m 3 d0 -0.001"
  lawWords = "power|exponential|barrier|table|signorini"
  lawNames = "power kappa m d0, exponential p0 beta d0, barrier p0 d0, table FILE d0, signorini"
  rubbing = "[friction MU [compliance c] [limit t]]"
  usage["contact"] = "contact SLAVE MASTER [gap vertical] [interference number] [conductance h0 [hardness H [exponent m]]] [law NAME ...] " rubbing ", with its parameters: " lawNames
  shapeNames = space ? "plane x y z nx ny nz, sphere x y z R r, cylinder x y z dx dy dz R r" : "plane x y nx ny, circle x y R r"
  shapeWords = space ? "plane|sphere|cylinder" : "plane|circle"
  usage["obstacle"] = "obstacle SLAVE SHAPE [inside] [move or force x y" at3 "] [interference number] [law NAME ...] " rubbing ", SHAPE one of: " shapeNames
  usage["clamp"] = "clamp NAME"
  usage["symmetry"] = "symmetry NAME"
  usage["move"] = "move NAME x y" at3
  usage["rotate"] = space ? "rotate NAME, centre x y z, axis x y z, angle in radians" : "rotate NAME, centre x y, angle in radians"
  usage["force"] = "force NAME x y" at3 " [free or rigid [at x y" at3 "]]"
  usage["moment"] = "moment NAME m" (space ? " axis x y z" : "") " [rigid or about x y" at3 "]"
  usage["about"] = "about NAME x y" at3
  usage["spring"] = "spring NAME kx ky" (space ? " kz" : "")
  usage["spin"] = space ? "spin BODY omega about x y z axis x y z" : "spin BODY omega [about x y]"
  usage["gravity"] = "gravity x y" at3
  usage["pressure"] = "pressure NAME number"
  usage["traction"] = "traction NAME x y" at3
  usage["cut"] = "cut NAME BODY plane x y" at3 " nx ny" (space ? " nz" : "")
  usage["join"] = "join BODY BODY part, tie or contact, a contact with what may stand behind its groups"
  usage["leg"] = "leg STEPS"
  usage["tie"] = "tie SLAVE MASTER"
  usage["weight"] = "weight NAME x y" at3
  manyOf[1] = "curves"; manyOf[2] = space ? "faces" : "surfaces"; manyOf[3] = "volumes"
  pickWords = manyOf[dim - 1] " " manyOf[dim] " box plane near between"
  pickList = pickWords
  gsub(/ /, "|", pickList)
  usage["group"] = "group NAME " manyOf[dim - 1] " N ..., " manyOf[dim] " N ..., box x y" at3 " x y" at3 ", plane x y" at3 " nx ny" \
    (space ? " nz" : "") ", near x y" at3 " or between BODY BODY"
  usage["size"] = "size NAME number or size contact number"
  wearing = "[wear K [slide S] [from FILE]]"
  sub(/\[friction/, wearing " [friction", usage["contact"])
  sub(/\[friction/, wearing " [friction", usage["obstacle"])
  usage["cycles"] = "cycles NUMBER [steps NUMBER]"
  example["cycles"] = "cycles 1e5 steps 40"
  does["cycles"] = "of wear, in so many steps"
  for (k in usage) statementWords = statementWords "|" k
  statementWords = substr(statementWords, 2)
  statementNames = "units, state, thickness, group, size, body, contact, obstacle, tie, join, clamp, symmetry, move, rotate, force, moment, spring, pressure, traction, weight, spin, gravity, expand, cut, preload, plastic, conduct, temperature, flux, film, stresses, line, about, cycles, leg"
  split("clamp no displacement|symmetry no displacement across a flat group|move a displacement that is given|rotate a small rotation" \
    "|force a resultant on a group|pressure along the normal, on a boundary|traction a force per area, on a boundary" \
    "|weight a force per volume on a body: density times gravity|body Young\047s modulus and Poisson\047s ratio" \
    "|contact two surfaces that may touch|obstacle a rigid shape that may touch|group faces or bodies of a geometry" \
    "|size of the elements|cut a plane through a body, for a preload|join two bodies that touch: one part, a tie or a contact|preload a shank pulled together|expand thermal strain|plastic yield stress and hardening of a body|conduct conductivity of a body|temperature of a group|flux of heat into a body|film heat exchanged with what is around|units of lengths and pressures" \
    "|state strain, stress or about an axis|thickness in the plane|stresses tensor, principal and von Mises|line results along it" \
    "|leg loads and motions reached in steps|tie two surfaces glued: no gap, no slip|moment on a group, by what it carries or as a rigid one|spring between a group and the ground" \
    "|spin a body\047s centrifugal force|gravity an acceleration of all bodies with a density|about a point that moments are told about", list, "|")
  for (k in list) { line = list[k]; sub(/ .*/, "", line); does[line] = substr(list[k], length(line) + 2) }
  split("fix fixed fixity encastre support anchor hold ground bc boundary:clamp|roller slider:symmetry|dload:weight|acceleration density:gravity" \
    "|bolt pretension tension:preload force|displacement disp displace:move|turn rotation:rotate|load cload:force" \
    "|material elastic steel:body|plasticity elastoplastic mises hardening:plastic|thermal shrink:expand|heat conductivity:conduct|temp:temperature|hflux heatflux:flux|convection:film|rigid wall ground:obstacle|set nset elset surface face select:group" \
    "|mesh h elementsize refine:size|unit:units|torque couple:moment|centrifugal centrif omega rpm rotation_speed:spin|foundation elastic_support bushing:spring|interface pair touch:contact|interference overlap:contact|tied bond bonded glue glued mortar:tie|coincident fragment touching:join|slice section split:cut", list, "|")
  for (k in list) {
    n = split(substr(list[k], 1, index(list[k], ":") - 1), own, " ")
    for (j = 1; j <= n; j++) leads[own[j]] = substr(list[k], index(list[k], ":") + 1)
  }
  instead["friction"] = instead["mu"] = instead["coulomb"] = "it stands behind a contact or an obstacle: contact SLAVE MASTER friction 0.3"
  instead["conductance"] = instead["hardness"] = "it stands behind a contact: contact SLAVE MASTER conductance 30"
  instead["wear"] = instead["archard"] = "it stands behind a contact or an obstacle: contact SLAVE MASTER wear 1e-8 slide 20"
  instead["weld"] = "join BODY BODY part makes two bodies of a geometry that touch one part; tie SLAVE MASTER glues two surfaces; bodies that share nodes are one part and need no statement (in gmsh: BooleanFragments, Coherence)"
  takes["power"] = "kappa m d0"; takes["exponential"] = "p0 beta d0"; takes["barrier"] = "p0 d0"; takes["signorini"] = ""; takes["table"] = "d0"
  parameter["kappa"] = 0; parameter["m"] = 1; parameter["p0"] = 2; parameter["beta"] = 3; parameter["d0"] = 4
  low["kappa"] = low["p0"] = low["beta"] = 0; low["m"] = 1; low["d0"] = -1e300
  high["kappa"] = high["p0"] = high["beta"] = 1e300; high["m"] = 1000; high["d0"] = 0
  split(shapeWords, list, "|")
  for (k in list) isShape[list[k]] = 1
  units = "none"
  state = space ? "none" : "strain"
  thickness = 1
}

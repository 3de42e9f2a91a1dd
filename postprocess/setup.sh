# setup.sh: installs what the package needs, and the package itself: sh postprocess/setup.sh TASK
# Needs: the package's folder as the present one; VENV, BUILD: where the Makefile keeps Python's packages and the plugins; CACHE.
# Tasks: the functions below that the Makefile names. Exit code 1: something is missing that cannot be had here, 10: refused.
# What is there already is left as it is.
set -u
VENV=${VENV:-.venv} BUILD=${BUILD:-build} CACHE=${CACHE:-}
python=$VENV/bin/python

installed() { dpkg-query -W -f '${Status}' "$1" 2>/dev/null | grep -q ' installed$'; }
there() { command -v "$1" >/dev/null; }

# Debian's packages, if any are named. A failed update is no reason to stop: the lists may be good enough, and if not, the
# install fails.
debian() # package...
{
    test $# -gt 0 || return 0
    if test "$(id -u)" = 0; then sudo=; else sudo='sudo -n'; fi
    if ! there apt-get || ! $sudo true 2>/dev/null; then
        echo "Please install: $* (Debian's names; there is no apt-get here, or no right to use it)"
        exit 1
    fi
    echo "Installing: $*"
    for pause in 0 5 30; do
        sleep $pause
        $sudo apt-get -q update </dev/null
        $sudo env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends -o DPkg::Lock::Timeout=300 \
            install "$@" </dev/null && return 0
    done
    echo "apt-get could not install: $*"
    exit 1
}

# The first Python that is new enough and has packages of its own within the bounds of requirements.txt; else the first that can
# make virtual environments with pip in them (Debian's needs a package for that). Sets found and interpreter.
find_python()
{
    for found in own venv; do
        for interpreter in python3 /usr/bin/python3; do
            $interpreter postprocess/doctor.py --can $found 2>/dev/null && return 0
        done
    done
    return 1
}

need_python() { find_python || { echo 'Please install Python 3.11 or newer, with its venv module'; exit 1; }; }

packages() # requirements: from PyPI into the environment, tried twice
{
    echo "Installing $1 into $VENV"
    for pause in 0 5; do
        sleep $pause
        "$python" -m pip install -q --no-input --disable-pip-version-check -r "$1" && return 0
    done
    exit 1
}

doctor() { find_python || interpreter=python3; exec $interpreter postprocess/doctor.py; }
interpreter() { find_python && exec $interpreter "$@"; }
can_compile() { there ff-c++ && there "${CXX:-g++}"; }

# A FreeFem++ that is not Debian's brings its own plugins: Debian's packages are not asked for beside it.
system()
{
    missing= freefem='freefem++ libfreefem++ libfreefem++-dev libopenblas0-pthread'
    if ! there FreeFem++; then missing=$freefem
    elif installed freefem++; then for package in $freefem; do installed $package || missing="$missing $package"; done; fi
    there gmsh || missing="$missing gmsh"
    find_python || missing="$missing python3 python3-venv"
    debian $missing
}

# Cases are read by Python with numpy and gmsh's module: Debian's packages, else the release of the program gmsh from PyPI.
reader()
{
    ready() { sh edp/input/read.sh 0 ready >/dev/null 2>&1; }
    ! ready || return 0
    (debian python3-numpy python3-gmsh) && ready && return 0
    make -s --no-print-directory "$VENV/run.stamp" && "$python" -m pip install -q --no-input --disable-pip-version-check \
        "gmsh==$(gmsh --version 2>&1 | grep -o '[0-9][0-9.]*')" && ready && return 0
    sh edp/input/read.sh 0 ready
    exit 1
}

python()
{
    need_python
    if test $found = own; then $interpreter -m venv --system-site-packages --without-pip "$VENV" || exit 1
    else $interpreter -m venv "$VENV" && packages requirements.txt; fi
}

develop()
{
    "$python" -c 'import ensurepip' 2>/dev/null || debian python3-venv
    "$python" -m pip --version >/dev/null 2>&1 || "$python" -m ensurepip >/dev/null
    packages requirements-dev.txt
}

peers()
{
    need_python
    echo "Installing requirements-peers.txt into $VENV-peers"
    $interpreter -m venv "$VENV-peers" && "$VENV-peers/bin/python" -m pip install -q --no-input --disable-pip-version-check \
        --retries 1 -r requirements-peers.txt 2>"$VENV-peers/pip.log" && return 0
    echo "bench-peers: pip could not install requirements-peers.txt (is a package index reachable?); its messages: $VENV-peers/pip.log"
    exit 1
}

# ---------------------------------------------------------------- plugins

# What is built is put in place once it is whole, the .idp that names it last: $1 plugin, $2 maker, $3 its macro. In the cache a
# .freefem++.pref names it: of FreeFEM's lists only those of HOME's come before this folder's.
name_plugin()
{
    printf '%s\n' "// written by make $2" "load \"$(basename "$1")\"" "macro $3 //" >"$1.idp"
    test -z "$CACHE" || { cat ~/.freefem++.pref 2>/dev/null; printf '%s += "'"$BUILD"'"\n' loadpath includepath; } >"$BUILD/.freefem++.pref"
}

fast() # plugin, source
{
    rm -rf "$BUILD/fast-new" "$1.idp"
    mkdir -p "$BUILD/fast-new" && cp "$2" "$BUILD/fast-new" && (
        cd "$BUILD/fast-new" && echo 'load "./fast"' >try.edp && { ff-c++ fast.cpp && FreeFem++ -nw -v 0 try.edp; } >../fast.log 2>&1
    ) && mv "$BUILD/fast-new/fast.so" "$1.so"
    code=$?
    rm -rf "$BUILD/fast-new"
    test $code = 0 || { echo "the plugin of make fast could not be built: $BUILD/fast.log"; exit 1; }
    name_plugin "$1" fast 'byPlugin(statement) statement'
}

petsc() # folder of PETSc, or nothing
{
    missing=
    test -n "$1" || missing=libpetsc-real-dev
    there mpicxx || missing="$missing libopenmpi-dev"
    there g++ || missing="$missing g++"
    debian $missing
}

multigrid() # plugin, folder of PETSc, source...
{
    plugin=$1 petsc=$2
    shift 2
    mkdir -p "$BUILD/new" && cp "$@" "$BUILD/new" && (
        cd "$BUILD/new" && if ls "$petsc"/lib/libpetsc_real.* >/dev/null 2>&1; then library=-lpetsc_real; else library=-lpetsc; fi
        ff-c++ -mpi -I"$petsc/include" $(mpicxx --showme:compile) -L"$petsc/lib" -Wl,-rpath,"$petsc/lib" $library \
            $(mpicxx --showme:link) multigrid.cpp >../multigrid.log 2>&1
    ) && mv "$BUILD/new/multigrid.so" "$plugin.so" || {
        grep -m 3 'error:' "$BUILD/multigrid.log" || tail -n 5 "$BUILD/multigrid.log"
        echo "the plugin could not be built with the PETSc in $petsc: $BUILD/multigrid.log"
        exit 1
    }
    rm -rf "$BUILD/new"
    name_plugin "$plugin" mpi 'multigridBuilt() 1'
    echo 'built: -solver multigrid, in scenes in space'
}

# What tests need beside the package: each is skipped where its tool is not there.
tools()
{
    missing=
    there chromium || there chromium-browser || there google-chrome || missing=chromium
    there ccx || missing="$missing calculix-ccx"
    test -e /usr/share/i18n/locales/de_DE || missing="$missing locales"
    debian $missing
}

# ---------------------------------------------------------------- a place of its own

install() # name of the starter, plugin...
{
    name=$1
    shift
    case $PREFIX in *[\;\'\"]* | [!/]* | '') echo "PREFIX=$PREFIX: allowed: a whole path without ; and quotes"; exit 10;; esac
    set -e
    share=${DESTDIR:-}$PREFIX/share/$name bin=${DESTDIR:-}$PREFIX/bin
    rm -rf "$share"
    mkdir -p "$share" "$bin"
    tar -cf - --exclude=__pycache__ --exclude=generated --exclude='*.msh' --exclude='.making-*' edp meshes postprocess \
        README.md CHANGELOG.md CITATION.cff LICENSE requirements.txt freefem++.pref | (cd "$share" && tar -xof -)
    for plugin; do
        test ! -e "$plugin.idp" || { mkdir -p "$share/build"; cp "$plugin.so" "$plugin.idp" "$share/build"; }
    done
    printf '%s\n' '#!/bin/sh' "# $name: scenes and Python commands of the package from any folder: $name wavy -h 0.1" \
        "CONTACT_STARTER=\$0 exec sh '$PREFIX/share/$name/edp/freefem.sh' \"\$@\"" >"$bin/$name"
    : >"$share/.installed"
    chmod -R a+rX "$share"
    chmod 755 "$bin/$name"
    echo "installed: $PREFIX/bin/$name"
}

uninstall() { rm -rf "${DESTDIR:-}$PREFIX/share/$1" "${DESTDIR:-}$PREFIX/bin/$1"; }

# What is begun sees the package through links: FreeFEM finds its modules, results stay outside.
new() # folder
{
    test -n "$1" || { echo 'DIR=: allowed: a folder that is not there yet'; exit 10; }
    test ! -e "$1" || { echo "DIR=$1: is there already"; exit 10; }
    mkdir -p "$1" && cp template/* "$1" || exit 1
    for name in edp meshes postprocess build freefem++.pref .venv; do ln -s "$PWD/$name" "$1" || exit 1; done
    echo "begun: $1; read its README.md, then: sh $1/test.sh"
}

"$@"

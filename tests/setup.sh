# Sourced by build-report and run-tests: the packages, and how to get them.

build_packages="cmake g++ ninja-build pkg-config libeigen3-dev libspectra-dev libtinyobjloader-dev libstb-dev libglm-dev libcli11-dev
    libsuitesparse-dev libopenblas-serial-dev libtbb-dev libdeflate-dev libhwy-dev nettle-dev nlohmann-json3-dev libpugixml-dev
    libkainjow-mustache-dev libtomlplusplus-dev libqpdf-dev libarchive-dev fonts-dejavu-core fonts-dejavu-extra chromium-headless-shell"
test_packages="clang-format-14 libgtest-dev libgmp-dev libembree-dev python3 libvalijson-dev libxml2-utils pandoc poppler-utils qpdf
    strace faketime locales"
command -v npm >/dev/null || test_packages="$test_packages nodejs npm"   # Debian's npm cannot stand beside a Node.js from elsewhere

# install_packages NAMES…: what is missing, through apt as root or sudo; otherwise says what to ask for.
install_packages() {
    missing=""
    for package in "$@"; do
        dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || missing="$missing $package"
    done
    [ -z "$missing" ] && return 0
    if [ "$(id -u)" = 0 ]; then
        as_root=""
    elif command -v sudo >/dev/null && { [ -t 0 ] || sudo -n true 2>/dev/null; }; then
        as_root="sudo"   # at a terminal it may ask for the password
    else
        echo "meshfolio needs these Debian packages, and this is neither root nor able to use sudo. Please have installed:" >&2
        echo "   $missing" >&2
        exit 5
    fi
    echo "installing:$missing" >&2
    # shellcheck disable=SC2086  # both are lists of words
    { $as_root apt-get update -qq && DEBIAN_FRONTEND=noninteractive $as_root apt-get install -qq -y --no-install-recommends $missing; } >&2
}

# build_release ROOT TESTS: the program at ROOT/build/release/meshfolio; TESTS is ON or OFF. Warnings are errors where the tests are built.
build_release() {
    cmake -S "$1" -B "$1/build/release" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMESHFOLIO_TESTS="$2" -DMESHFOLIO_WERROR="$2" -DMESHFOLIO_JOIN_SOURCES=ON >&2
    cmake --build "$1/build/release" >&2
}

# Lists and installs the packages. build-report and run-tests source this file.

clang_format=clang-format-14   # other versions format the sources differently
build_packages="cmake g++ ninja-build pkg-config libeigen3-dev libspectra-dev libtinyobjloader-dev libstb-dev libglm-dev libcli11-dev
    libtbb-dev libdeflate-dev libhwy-dev nettle-dev nlohmann-json3-dev libpugixml-dev
    libkainjow-mustache-dev libtomlplusplus-dev libqpdf-dev libarchive-dev fonts-texgyre fonts-texgyre-math fonts-inter
    fonts-dejavu-core python3-fonttools python3-brotli chromium-headless-shell"
# For the Python module and its tests.
python_packages="pybind11-dev python3-dev python3-numpy python3-scipy python3-nbclient python3-ipykernel python3-matplotlib"
test_packages="$clang_format libgtest-dev libgmp-dev libembree-dev python3 libvalijson-dev libxml2-utils pandoc weasyprint poppler-utils qpdf
    strace faketime locales $python_packages"
command -v npm >/dev/null || test_packages="$test_packages nodejs npm"   # Debian's npm conflicts with a Node.js from another source
# Some distributions do not have these (apt has no Chromium on Ubuntu). The program is built without them.
optional_packages="chromium-headless-shell $clang_format libembree-dev nodejs npm weasyprint
    $python_packages"

# apt_install NAMES…: installs as root or by sudo. Returns 1 if neither is possible.
apt_install() {
    if [ "$(id -u)" = 0 ]; then
        as_root=""
    elif command -v sudo >/dev/null && { [ -t 0 ] || sudo -n true 2>/dev/null; }; then
        as_root="sudo"   # at a terminal sudo may ask for the password
    else
        return 1
    fi
    echo "installing: $*" >&2
    # shellcheck disable=SC2086  # sudo or nothing
    { $as_root apt-get update -qq && DEBIAN_FRONTEND=noninteractive $as_root apt-get install -qq -y --no-install-recommends "$@"; } >&2
}

# install_packages NAMES…: installs the missing packages with apt, or prints their names and exits with 5. If apt cannot install all together,
# it tries optional packages one by one.
install_packages() {
    required="" optional="" without=""
    for package in "$@"; do
        dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed && continue
        case " $(echo $optional_packages) " in
            *" $package "*) optional="$optional $package" ;;
            *) required="$required $package" ;;
        esac
    done
    # shellcheck disable=SC2086  # lists of words
    if [ -z "$required$optional" ] || apt_install $required $optional; then return 0; fi
    # shellcheck disable=SC2086
    if [ -n "$required" ] && ! apt_install $required; then
        echo "meshfolio needs these packages; apt failed, or this user is neither root nor has sudo:" >&2
        echo "   $required" >&2
        exit 5
    fi
    for package in $optional; do   # do not ask for a password for an unknown package
        { apt-cache show "$package" >/dev/null 2>&1 && apt_install "$package"; } || without="$without $package"
    done
    [ -z "$without" ] || echo "continuing without these packages, which apt could not install:$without" >&2
}

# build_release ROOT TESTS: builds ROOT/build/release/meshfolio; TESTS is ON or OFF. With tests, warnings are errors.
build_release() {
    cmake -S "$1" -B "$1/build/release" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMESHFOLIO_TESTS="$2" -DMESHFOLIO_WERROR="$2" -DMESHFOLIO_JOIN_SOURCES=ON >&2
    cmake --build "$1/build/release" >&2
}

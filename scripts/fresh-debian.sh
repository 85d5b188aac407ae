# Sourced by check-packages and check-debian: fresh_debian RELEASE makes a minimal Debian 12 or 13 in the folder "$root", with
# debootstrap from the mirror that this machine uses, as root only; `inside COMMAND...` runs there. The folder goes at the end.
fresh_debian() {
  local codename
  case $1 in
    12) codename=bookworm ;;
    13) codename=trixie ;;
    *) echo "RELEASE is '$1'; it is 12 or 13" >&2; exit 2 ;;
  esac
  [ "$(id -u)" -eq 0 ] || { echo "debootstrap needs root" >&2; exit 2; }
  root=$(mktemp -d)
  chmod 755 "$root"
  trap remove_debian EXIT
  step "a fresh Debian $1"
  local mirror
  mirror=$(apt-cache policy | grep -om1 'https\?://[^ ]*/debian' || true)
  debootstrap --variant=minbase "$codename" "$root" $mirror >"$root.log" 2>&1 || { tail -5 "$root.log"; exit 1; }
  rm "$root.log"
  mount -t proc proc "$root/proc"
  mount --bind /dev "$root/dev"
  mount --bind /dev/pts "$root/dev/pts"
  mount -t tmpfs tmpfs "$root/dev/shm"
  local settings
  for settings in /etc/apt/apt.conf.d/*proxy* /etc/apt/apt.conf; do
    [ ! -f "$settings" ] || cp "$settings" "$root/etc/apt/apt.conf.d/"
  done
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  echo "127.0.0.1 localhost" >"$root/etc/hosts"  # as the installer of Debian does
  mkdir -p "$root/etc/trusted"
  cp /etc/ssl/certs/ca-certificates.crt "$root/etc/trusted/"  # npm needs the certificates of this machine's network, too
  inside apt-get -qq update
}

remove_debian() {
  umount -q "$root/proc" "$root/dev/pts" "$root/dev/shm" "$root/dev" || true
  rm -rf --one-file-system "$root"
}

inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
  DEBIAN_FRONTEND=noninteractive NPM_CONFIG_CAFILE=/etc/trusted/ca-certificates.crt "$@"; }

step() { echo "== $*"; }

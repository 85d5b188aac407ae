#!/bin/sh
# sh cover.sh /usr/include/tbb:/usr/include/png.h COMMAND...: runs a command that finds nothing in these folders and
# files.
# To be run with mounts of its own (unshare --mount).
set -e
mount --make-rprivate /
nothing=$(mktemp -d)
headers=$1
shift
for path in $(echo "$headers" | tr ':' ' '); do
  if [ -d "$path" ]; then
    mount --bind "$nothing" "$path"
    test -z "$(ls "$path")"
  elif [ -e "$path" ]; then
    mount --bind /dev/null "$path"
  fi
done
status=0
"$@" || status=$?
rmdir "$nothing" 2>/dev/null || true
exit $status

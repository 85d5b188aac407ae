#!/bin/sh
# sh cover.sh EMPTY /usr/include/tbb:/usr/include/png.h COMMAND...: runs a command that finds nothing in these folders
# and files. EMPTY is an empty folder. To be run with mounts of its own (unshare --mount).
set -e
empty=$1
paths=$2
shift 2
mount --make-rprivate /
for path in $(echo "$paths" | tr ':' ' '); do
  if [ -d "$path" ]; then
    mount --bind "$empty" "$path"
    test -z "$(ls "$path")"
  elif [ -e "$path" ]; then
    mount --bind /dev/null "$path"
  fi
done
exec "$@"

#!/bin/bash
# The steps of pipeline/Containerfile, one after the other in a fresh Debian system: what a container engine would do, for
# machines that have none.
. "$(dirname "$0")/chroot.sh"
read_arguments container "$@"

make_system
fresh_clone /context
environment=() place=/ number=0
while read -r word rest <&3; do
  case $word in
    FROM) [[ $rest == "debian:$(sed 's/\..*//' "$folder/etc/debian_version")" ]] || { echo "not a system of $rest" >&2 && exit 2; } ;;
    COPY)
      read -r -a names <<< "$rest"
      target="$folder${names[-1]}"
      mkdir -p "$target"
      for name in "${names[@]::${#names[@]}-1}"; do
        # A file goes into the folder, of a folder what is in it.
        if [[ -d $folder/context/$name ]]; then rm -rf "$target" && cp -r "$folder/context/$name" "$target"; else cp "$folder/context/$name" "$target"; fi
      done
      ;;
    RUN) step "run-$((++number))" env "${environment[@]}" sh -c "cd $place && $rest" ;;
    ENV) environment+=("$(in_system env "${environment[@]}" sh -c "echo \"$rest\"")") ;;
    WORKDIR) place=$rest && mkdir -p "$folder$place" ;;
    CMD) step command env "${environment[@]}" sh -c "cd $place && ${rest//[][,]/ }" && cat "$folder/command.log" ;;
  esac
done 3< <(sed -e :a -e '/\\$/N; s/\\\n//; ta' -e '/^#/d' "$top/pipeline/Containerfile")
[[ ! $failed ]]

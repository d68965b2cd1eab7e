#!/bin/sh
# Makes a still and a short animation of every scene directly under scenes/: cmake --build --preset release --target gallery
# Arguments: the program erbs, the root of the tree, a folder for the runs.
set -eu
erbs=$1 root=$2 runs=$3
mkdir -p "$runs"

# picture NAME "OPTIONS OF RUN" STILL(s) FROM:TO(s) SLOW "OPTIONS OF RENDER": films the scene NAME with one camera.
picture() {
  name=$1 still=$3 span=$4 slow=$5 folder=$runs/$1
  echo "gallery: $name"
  # Options are separate words, of which none contains a blank.
  # shellcheck disable=SC2086
  "$erbs" run "$root/scenes/$name.lua" $2 -o "$folder" --force --quiet
  # shellcheck disable=SC2086
  "$erbs" render "$folder" $6 --size 960x600 --stills "$still" --no-figures --force --quiet
  mv "$folder"/frames/*_t*s.png "$root/media/$name.png"
  # shellcheck disable=SC2086
  "$erbs" render "$folder" $6 --size 480x360 --time "$span" --slow "$slow" --fps 15 --webp --no-overlay --no-figures --force --quiet
  mv "$folder"/*.webp "$root/media/$name.webp"
}

picture first "" 0.95 0:2 2 "--eye 2.5,-2.9,1.3 --target 0,-0.25,0.5 --fov 26"
picture wall_corner "" 0.72 0.1:1.6 2 "--eye=3.5,-3.8,2.5 --target 0.15,-0.1,0.35 --fov 33"
picture tilting_walls "" 6.5 3:7.4 1 "--eye 5.2,-5.2,3.6 --target 0.7,0.3,0.9 --fov 33"
picture window_wall "-D peak=3*g" 1.15 0.1:2.1 2 "--eye=4.5,-5.0,2.9 --target 0.55,-0.2,0.8 --fov 34"
picture dry_wall_verdict "-D peak=0.3*g" 1.8 0.6:1.85 2 "--eye 4.2,-5.2,2.6 --fov 34 --fit"
picture house_quality "--set frame_dt=0.005" 0.2 0:0.25 12 "--camera three_quarter --color displacement --magnify 2000"
picture sequential_study "" 0.4 0:0.6 4 "--camera front --color displacement --magnify 100"
picture shake_table_house "-D pga=3*g -D duration=2.8" 2.1 1.35:2.8 3 "--eye 6.4,-7.6,4.0 --target=-0.6,0,1.5 --fov 33"
picture metu_house "-D dynamic=1" 7.6 5.5:9 1.5 "--eye=6.6,-7.6,4.2 --target 0.2,0,1.3 --fov 33"
picture valens_aqueduct "-D bays=2 -D dynamic=1 -D ramp=5 -D peak=0.4*g" 5.6 0.5:7 1.5 "--eye=-27,-33,13 --target 0,1.5,9.5 --fov 40 --hide plane"
picture box_lintel "-D criterion=\"alpha\" -D amplitude=2.6 -D cycles=1 --set frame_dt=0.02" 1.4 0.3:2 2 "--eye 8.6,-9.4,5.6 --target 0.4,0,1.5"

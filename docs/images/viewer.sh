#!/bin/sh
# docs/images/viewer.sh: draws the README's picture of the window anew, docs/images/viewer.png, on a display in memory.
# Needs scripts/setup test, and ImageMagick to make the file small.
set -eu
cd "$(dirname "$0")/../.."
if [ "${1:-}" != inside ]; then
    scripts/build dioptre dioptre_grab_window
    exec tests/app/with_display 1200x680 docs/images/viewer.sh inside
fi

# A pupil so wide that blur is seen at this size, and focus on the globe; sharp right of the line
build/release/dioptre view builtin:studio --eye centre --size 810x680 --gaze-source point --gaze 0.36,0.62 \
    --aperture-mm 12 --technique accumulate --samples 64 &
program=$!
folder=$(mktemp -d)
trap 'kill $program; rm -r "$folder"' EXIT
until window=$(xdotool search --onlyvisible --name '^Dioptre: .*focus' 2>/dev/null); do
    kill -0 $program
    sleep 0.1
done
xdotool windowsize --sync "$window" 1200 680 windowfocus "$window" key F2 key t
until xdotool getwindowname "$window" | grep -q ' dB, SSIM'; do sleep 0.5; done
sleep 1
build/release/tests/dioptre_grab_window "$window" "$folder/window.png"
convert "$folder/window.png" -colors 256 PNG8:docs/images/viewer.png

# gnuplot docs/images/mipmap-error.gp, from the repository's root: the table of docs/measured.md as a picture.
set terminal svg size 640,400 font "sans-serif,13" background "#fffefb"
set output "docs/images/mipmap-error.svg"
$ssim << TABLE
2 0.9615 0.9636 0.9688 0.9684 0.9585 0.9673
8 0.9557 0.9437 0.9844 0.9680 0.9668 0.9576
20 0.9263 0.9072 0.9627 0.9559 0.9474 0.9325
TABLE
set xlabel "mean CoC diameter, px at 640x480"
set ylabel "SSIM to the reference"
set xtics (2, 8, 20)
set yrange [0.9:1]
set grid linecolor "#dddddd"
set key bottom left
plot 0.95 dashtype 2 linecolor "#888888" notitle, \
     $ssim using 1:2 with linespoints linewidth 2 pointtype 7 dashtype 1 linecolor "#1f6f8b" title "studio, near focus", \
     $ssim using 1:3 with linespoints linewidth 2 pointtype 6 dashtype 3 linecolor "#1f6f8b" title "studio, far focus", \
     $ssim using 1:4 with linespoints linewidth 2 pointtype 7 dashtype 1 linecolor "#b5500b" title "toys, near focus", \
     $ssim using 1:5 with linespoints linewidth 2 pointtype 6 dashtype 3 linecolor "#b5500b" title "toys, far focus", \
     $ssim using 1:6 with linespoints linewidth 2 pointtype 7 dashtype 1 linecolor "#4b8b3b" title "fishes, near focus", \
     $ssim using 1:7 with linespoints linewidth 2 pointtype 6 dashtype 3 linecolor "#4b8b3b" title "fishes, far focus"

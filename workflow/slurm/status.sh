#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# State of a Slurm job for Snakemake: running, success or failed. A job that the controller no longer lists has failed;
# the next call of Snakemake finds its results.
state=$(scontrol show job "$1" 2>/dev/null | sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p' | head -1)
case $state in
PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | REQUEUED | RESIZING) echo running ;;
COMPLETED) echo success ;;
*) echo failed ;;
esac

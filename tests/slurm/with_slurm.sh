#!/usr/bin/env bash
# Run a command on a Slurm cluster of one node, this machine, that ends with the command.
#
#   with_slurm.sh FOLDER COMMAND...
#
# FOLDER takes configuration, state and logs. All daemons live in name spaces of their own: they
# listen on the loopback interface alone, /etc/slurm of the machine is not touched (jobs look for
# the configuration there and nowhere else), and nothing outlives the command.
set -euo pipefail

if [[ "${WITH_SLURM_INSIDE:-}" != yes ]]; then
  WITH_SLURM_INSIDE=yes exec unshare --mount --pid --fork --kill-child --mount-proc "$0" "$@"
fi

folder=$(realpath "$1")
shift
host=$(hostname -s)
mkdir -p "$folder"/{etc,state,spool} /etc/slurm
mount --bind "$folder/etc" /etc/slurm

cat >/etc/slurm/slurm.conf <<CONF
ClusterName=gipkg
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
MinJobAge=300
InactiveLimit=0
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 RealMemory=${WITH_SLURM_MEMORY:-8000} State=UNKNOWN
PartitionName=debug Nodes=ALL Default=YES MaxTime=INFINITE State=UP DefMemPerCPU=500
CONF

(umask 077 && head -c 1024 /dev/urandom >"$folder/munge.key")
munged --force --socket "$folder/munge.socket" --key-file "$folder/munge.key" \
  --pid-file "$folder/munge.pid" --log-file "$folder/munge.log" --seed-file "$folder/munge.seed"
slurmctld
slurmd
for _ in $(seq 30); do
  [[ "$(sinfo --noheader --format %t 2>/dev/null)" == idle ]] && break
  sleep 1
done
if [[ "$(sinfo --noheader --format %t)" != idle ]]; then
  echo "Slurm did not start:" >&2
  tail -n 5 "$folder"/*.log >&2
  exit 70
fi
"$@"

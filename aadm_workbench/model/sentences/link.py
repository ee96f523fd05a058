"""What is said of links to machines that do not come about."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "link.authority": Sentence(
        "{folder}: needs ca.pem, the broker's authority ({why})", "{folder}：需要 ca.pem，即代理的根证书（{why}）"
    ),
    "link.halved": Sentence(
        "{folder}: holds one of certificate.der and key.pem; both are needed, or none",
        "{folder}：certificate.der 与 key.pem 只有其一；须两者都有，或都没有",
    ),
    "link.no_broker": Sentence(
        "{broker}: is no broker; write HOST or HOST:PORT", "{broker}：不是 MQTT 代理地址；请写 HOST 或 HOST:PORT"
    ),
    "link.not_listening": Sentence(
        "{where}: cannot listen ({why}); is the port taken?", "{where}：无法监听（{why}）；端口是否已被占用？"
    ),
    "link.port": Sentence(
        "{where}: cannot listen; is the port taken, or below 1024?",
        "{where}：无法监听；端口是否已被占用，或小于 1024？",
    ),
    "link.refused": Sentence(
        "{address}: the MQTT broker refuses the connection ({why:word})", "{address}：MQTT 代理拒绝连接（{why:word}）"
    ),
    "link.silent": Sentence(
        "{address}: the MQTT broker does not answer ({why})", "{address}：MQTT 代理没有应答（{why}）"
    ),
}
